# plm_add_library(NAME SOURCES...): a core library; headers are included relative to the package root.
function(plm_add_library name)
  plm_add_static_library(${name} ${ARGN})
  plm_use_header_set(core ${name})
endfunction()

# plm_export(NAME...): other packages may link these libraries (find_package(plm_vins)).
function(plm_export)
  install(TARGETS ${ARGN} EXPORT plm_vinsTargets ARCHIVE DESTINATION lib)
endfunction()

# plm_add_ros_library(NAME SOURCES...): a library of a ros/ folder; only these may use ROS.
function(plm_add_ros_library name)
  plm_add_library(${name} ${ARGN})
  plm_use_ros(${name})
endfunction()

# plm_add_node_library(NAME SOURCES...): a library of a ros/ folder for nodes.
function(plm_add_node_library name)
  plm_add_static_library(${name} ${ARGN})
  plm_use_ros(${name})
  plm_use_header_set(ros ${name})
endfunction()

function(plm_use_ros target)
  target_include_directories(${target} SYSTEM PUBLIC ${ROS_INCLUDE_DIRS})
  target_link_libraries(${target} PUBLIC ${ROS_LIBRARIES})
endfunction()

# plm_add_static_library(NAME SOURCES...): the common part of all libraries.
function(plm_add_static_library name)
  add_library(${name} STATIC ${ARGN})
  plm_group_sources(${name})
  target_include_directories(${name} PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>
                             $<INSTALL_INTERFACE:include/${PROJECT_NAME}>)
  target_include_directories(${name} SYSTEM PUBLIC ${EIGEN3_INCLUDE_DIRS} ${OpenCV_INCLUDE_DIRS})
endfunction()

# plm_group_sources(TARGET): compiles the sources of a target together, which parses headers and
# instantiates the templates of Eigen once for all of them. So names in unnamed namespaces are unique
# in a target.
option(PLM_GROUP_SOURCES "Compile the sources of a target together" ON)
function(plm_group_sources target)
  set_target_properties(${target} PROPERTIES UNITY_BUILD ${PLM_GROUP_SOURCES}
                        UNITY_BUILD_BATCH_SIZE 0)
endfunction()

# plm_group_by_folder(TARGET): compiles the sources of each folder of a large target together. CMake
# before 3.18 cannot, and compiles each source on its own.
function(plm_group_by_folder target)
  if(CMAKE_VERSION VERSION_LESS 3.18)
    set_target_properties(${target} PROPERTIES UNITY_BUILD OFF)
    return()
  endif()
  get_target_property(sources ${target} SOURCES)
  foreach(source ${sources})
    get_filename_component(folder ${source} DIRECTORY)
    string(MAKE_C_IDENTIFIER "in_${folder}" group)
    set_source_files_properties(${source} PROPERTIES UNITY_GROUP ${group})
  endforeach()
  set_target_properties(${target} PROPERTIES UNITY_BUILD_MODE GROUP)
endfunction()

# plm_add_nodelet(NAME SOURCES...): a library of nodelets, listed in nodelet_plugins.xml.
function(plm_add_nodelet name)
  add_library(${name} SHARED ${ARGN})
  target_include_directories(${name} PRIVATE ${PROJECT_SOURCE_DIR})
  plm_use_header_set(ros ${name})
  install(TARGETS ${name} LIBRARY DESTINATION lib)
endfunction()

# plm_add_tests(PROGRAM TESTS NAME... LIBRARIES LIBRARY...): builds the NAME_test.cpp of this folder
# into one GoogleTest program, which ctest runs once for each file, as NAME_test.
function(plm_add_tests program)
  cmake_parse_arguments(ARG "" "" "TESTS;LIBRARIES" ${ARGN})
  list(TRANSFORM ARG_TESTS APPEND _test.cpp OUTPUT_VARIABLE sources)
  add_executable(${program} EXCLUDE_FROM_ALL ${sources})
  plm_group_sources(${program})
  add_dependencies(tests ${program})
  plm_use_header_set(test ${program})
  target_link_libraries(${program} PRIVATE ${ARG_LIBRARIES} GTest::gmock GTest::GTest GTest::Main)
  set_target_properties(${program} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/tests)
  foreach(name ${ARG_TESTS})
    plm_test_suites(${name}_test.cpp suites)
    add_test(NAME ${name}_test COMMAND ${program} --gtest_filter=${suites}
             --gtest_output=xml:${PLM_TEST_RESULTS}/${name}_test.xml)
    set_tests_properties(${name}_test PROPERTIES LABELS unit)
  endforeach()
endfunction()

# plm_add_test_library(NAME SOURCES...): code that tests share; compiled only with them.
function(plm_add_test_library name)
  plm_add_library(${name} ${ARGN})
  set_target_properties(${name} PROPERTIES EXCLUDE_FROM_ALL TRUE)
endfunction()

# plm_test_suites(FILE OUT): sets OUT to the GoogleTest filter of all suites in a file; parameterized
# suites have a prefix.
function(plm_test_suites file out)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${file})
  file(STRINGS ${file} tests REGEX "^TEST(_F|_P)?\\(")
  list(TRANSFORM tests REPLACE "^TEST[_FP]*\\(([A-Za-z0-9_]+),.*" "\\1")
  list(REMOVE_DUPLICATES tests)
  list(TRANSFORM tests REPLACE "(.+)" "\\1.*:*/\\1.*")
  list(JOIN tests ":" filter)
  set(${out} ${filter} PARENT_SCOPE)
endfunction()

# plm_add_executable(NAME SOURCES...): a program that roslaunch can find.
function(plm_add_executable name)
  plm_add_program(core ${name} ${ARGN})
endfunction()

# plm_add_node(NAME SOURCES...): a ROS node that roslaunch can find.
function(plm_add_node name)
  plm_add_program(ros ${name} ${ARGN})
endfunction()

# The common part of plm_add_executable and plm_add_node.
function(plm_add_program header_set name)
  add_executable(${name} ${ARGN})
  plm_group_sources(${name})
  plm_use_header_set(${header_set} ${name})
  install(TARGETS ${name} RUNTIME DESTINATION lib/${PROJECT_NAME})
  if(BUILD_TESTING)
    add_dependencies(tests ${name})
  endif()
endfunction()
