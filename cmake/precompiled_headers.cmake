# Precompiled headers of the libraries that most sources include. There are three sets, core, test and
# ros, since a source can use only one. GCC requires the flags that a set was compiled with. Without
# them (OFF) the compiler finds missing includes.
option(PLM_PRECOMPILED_HEADERS "Parse common headers of libraries once" ON)

# plm_add_header_set(SET HEADERS...): defines a set, compiled by a target of its own.
function(plm_add_header_set set)
  if(NOT PLM_PRECOMPILED_HEADERS)
    return()
  endif()
  set(source ${CMAKE_BINARY_DIR}/precompiled/${set}.cpp)
  if(NOT EXISTS ${source})
    file(WRITE ${source} "")  # a target needs a source
  endif()
  add_library(plm_${set}_headers OBJECT EXCLUDE_FROM_ALL ${source})
  target_include_directories(plm_${set}_headers SYSTEM PRIVATE ${EIGEN3_INCLUDE_DIRS}
                             ${OpenCV_INCLUDE_DIRS} ${ROS_INCLUDE_DIRS})
  target_precompile_headers(plm_${set}_headers PRIVATE ${ARGN})
endfunction()

# plm_use_header_set(SET TARGET)
function(plm_use_header_set set target)
  if(PLM_PRECOMPILED_HEADERS)
    target_precompile_headers(${target} REUSE_FROM plm_${set}_headers)
  endif()
endfunction()

if(PLM_PRECOMPILED_HEADERS)
  add_compile_options(-fpch-preprocess)  # required by ccache
endif()
set(core_headers <Eigen/Dense> <algorithm> <array> <cmath> <cstdint> <deque> <functional> <map>
    <memory> <opencv2/core.hpp> <optional> <set> <stdexcept> <string> <unordered_map> <vector>)
plm_add_header_set(core ${core_headers})
if(BUILD_TESTING)
  plm_add_header_set(test ${core_headers} <gmock/gmock.h> <gtest/gtest.h>)
  if(PLM_PRECOMPILED_HEADERS)
    target_link_libraries(plm_test_headers PRIVATE GTest::GTest)  # for its definitions
  endif()
endif()
if(BUILD_ROS)
  plm_add_header_set(ros ${core_headers} <ros/ros.h> <sensor_msgs/Image.h> <sensor_msgs/Imu.h>
                     <sensor_msgs/PointCloud.h>)
endif()
