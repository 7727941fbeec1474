# rosrun ignores build/ of a package, where a build inside the package puts its programs, but follows
# this link. (roslaunch finds the programs anyway, and does not follow hidden links.)
if(BUILD_ROS AND CMAKE_BINARY_DIR STREQUAL "${PROJECT_SOURCE_DIR}/build")
  file(CREATE_LINK build/devel/lib/${PROJECT_NAME} ${PROJECT_SOURCE_DIR}/.rosrun RESULT unused SYMBOLIC)
endif()
