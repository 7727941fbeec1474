# rosrun leaves out what lies below build/ of a package, where a build inside of it puts its
# programs; it follows this link. (roslaunch finds them as it is, and follows no hidden link.)
if(BUILD_ROS AND CMAKE_BINARY_DIR STREQUAL "${PROJECT_SOURCE_DIR}/build")
  file(CREATE_LINK build/devel/lib/${PROJECT_NAME} ${PROJECT_SOURCE_DIR}/.rosrun RESULT unused SYMBOLIC)
endif()
