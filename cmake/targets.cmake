# plm_add_library(NAME SOURCES... ): a core library; included from the package root.
function(plm_add_library name)
  add_library(${name} STATIC ${ARGN})
  target_include_directories(${name} PUBLIC ${PROJECT_SOURCE_DIR})
  target_include_directories(${name} SYSTEM PUBLIC ${EIGEN3_INCLUDE_DIRS} ${OpenCV_INCLUDE_DIRS})
endfunction()

# plm_add_ros_library(NAME SOURCES...): a library of a ros/ folder, the only kind that sees ROS.
function(plm_add_ros_library name)
  plm_add_library(${name} ${ARGN})
  target_include_directories(${name} SYSTEM PUBLIC ${ROS_INCLUDE_DIRS})
  target_link_libraries(${name} PUBLIC ${ROS_LIBRARIES})
endfunction()

# plm_add_nodelet(NAME SOURCES...): a library of nodelets, named in nodelet_plugins.xml.
function(plm_add_nodelet name)
  add_library(${name} SHARED ${ARGN})
  target_include_directories(${name} PRIVATE ${PROJECT_SOURCE_DIR})
  install(TARGETS ${name} LIBRARY DESTINATION lib)
endfunction()

# plm_add_test(NAME LIBRARIES...): builds NAME_test.cpp of this folder as one GoogleTest program.
function(plm_add_test path)
  set(name ${path}_test)
  add_executable(${name} ${path}_test.cpp)
  target_link_libraries(${name} PRIVATE ${ARGN} GTest::GTest GTest::Main)
  set_target_properties(${name} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/tests)
  add_test(NAME ${name} COMMAND ${name})
endfunction()

# plm_add_executable(NAME SOURCES...): a program that rosrun and roslaunch find.
function(plm_add_executable name)
  add_executable(${name} ${ARGN})
  install(TARGETS ${name} RUNTIME DESTINATION lib/${PROJECT_NAME})
endfunction()
