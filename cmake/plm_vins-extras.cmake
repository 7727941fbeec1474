# The targets of plm_vins and what they link. Read by find_package(plm_vins), also by way of catkin.
include(CMakeFindDependencyMacro)
find_dependency(Threads)
find_dependency(Eigen3)
find_dependency(OpenCV)
find_dependency(Ceres)
find_dependency(yaml-cpp)
find_dependency(nlohmann_json)
if(NOT TARGET yaml-cpp::yaml-cpp)  # yaml-cpp before 0.8 exports a bare name
  add_library(yaml-cpp::yaml-cpp INTERFACE IMPORTED)
  target_link_libraries(yaml-cpp::yaml-cpp INTERFACE yaml-cpp)
endif()
include(${plm_vins_DIR}/plm_vinsTargets.cmake)
set(plm_vins_LIBRARIES plm_vins::plm_feature_tracker plm_vins::plm_linefeature_tracker
    plm_vins::plm_estimation_stage plm_vins::plm_output)
