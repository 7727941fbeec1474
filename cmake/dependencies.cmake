find_package(Threads REQUIRED)
find_package(Eigen3 3.3 REQUIRED NO_MODULE)
find_package(OpenCV 4 REQUIRED COMPONENTS core imgproc imgcodecs calib3d video
             features2d ximgproc)
find_package(Ceres REQUIRED)
find_package(yaml-cpp REQUIRED)
if(NOT TARGET yaml-cpp::yaml-cpp)  # yaml-cpp before 0.8 exports a bare name
  add_library(yaml-cpp::yaml-cpp INTERFACE IMPORTED)
  target_link_libraries(yaml-cpp::yaml-cpp INTERFACE yaml-cpp)
endif()
find_package(Boost REQUIRED COMPONENTS program_options)
find_package(nlohmann_json REQUIRED)

if(BUILD_ROS)
  # ROS packages of a distribution need its own Python, not a pyenv or conda found in PATH.
  if(EXISTS /usr/bin/python3)
    set(PYTHON_EXECUTABLE /usr/bin/python3 CACHE FILEPATH "Python of catkin")
    set(Python3_EXECUTABLE /usr/bin/python3 CACHE FILEPATH "Python of ament")
  endif()
  find_package(catkin REQUIRED COMPONENTS
    cv_bridge diagnostic_updater geometry_msgs image_transport nav_msgs nodelet
    pluginlib rosbag roscpp sensor_msgs std_msgs std_srvs tf2_msgs tf2_ros visualization_msgs)
  catkin_package(CFG_EXTRAS plm_vins-extras.cmake)
  # Debian nests the headers that rosbag/bag.h needs one folder deeper than ROS does.
  set(ROS_INCLUDE_DIRS ${CATKIN_DEVEL_PREFIX}/include ${catkin_INCLUDE_DIRS})
  foreach(package pluginlib class_loader rcutils rcpputils ament_index_cpp)
    if(EXISTS /usr/include/${package}/${package})
      list(APPEND ROS_INCLUDE_DIRS /usr/include/${package})
    endif()
  endforeach()
  find_library(CLASS_LOADER_LIBRARY class_loader)
  set(ROS_LIBRARIES ${catkin_LIBRARIES})
  if(CLASS_LOADER_LIBRARY)
    list(APPEND ROS_LIBRARIES ${CLASS_LOADER_LIBRARY})
  endif()
else()
  set(CMAKE_RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/devel/lib/${PROJECT_NAME})
endif()

if(BUILD_TESTING)
  find_package(GTest REQUIRED)
  if(NOT TARGET GTest::gmock)  # not provided by CMake before 3.23
    # By file, since the target gmock of Noetic's catkin adds a second gtest.
    find_library(GMOCK_LIBRARY gmock)
    if(NOT GMOCK_LIBRARY)
      message(FATAL_ERROR "gmock is missing: install libgmock-dev or set BUILD_TESTING=OFF")
    endif()
    add_library(GTest::gmock UNKNOWN IMPORTED)
    set_target_properties(GTest::gmock PROPERTIES IMPORTED_LOCATION ${GMOCK_LIBRARY}
                          INTERFACE_LINK_LIBRARIES GTest::GTest)
  endif()
endif()
if(BUILD_BENCHMARKS)
  find_package(benchmark REQUIRED)
endif()
