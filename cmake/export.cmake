# Installs all that other packages need to link the core: headers, static libraries, and a CMake
# package that defines plm_vins::plm_estimation_stage and so on. With ROS, catkin writes
# plm_vinsConfig.cmake, which includes plm_vins-extras.cmake; without ROS, plm_vins-extras.cmake is
# the package itself.
include(CMakePackageConfigHelpers)

set(package_folder share/${PROJECT_NAME}/cmake)
plm_export(plm_common plm_state plm_tracking plm_feature_tracker plm_linefeature_tracker
           plm_estimator plm_estimation_stage plm_output)
if(PLM_LOOP_CLOSURE)
  plm_export(plm_pose_graph)
endif()
if(PLM_OFFLINE)
  plm_export(plm_map_bundle)
endif()
install(EXPORT plm_vinsTargets NAMESPACE plm_vins:: DESTINATION ${package_folder})
foreach(folder common tracking feature_tracker linefeature_tracker vins_estimator pose_graph
        map_bundle)
  install(DIRECTORY ${folder} DESTINATION include/${PROJECT_NAME}
          FILES_MATCHING PATTERN "*.h" PATTERN ros EXCLUDE)
endforeach()

if(BUILD_ROS)
  export(EXPORT plm_vinsTargets NAMESPACE plm_vins::
         FILE ${CATKIN_DEVEL_PREFIX}/${package_folder}/plm_vinsTargets.cmake)
else()
  install(FILES cmake/plm_vins-extras.cmake DESTINATION ${package_folder}
          RENAME plm_vinsConfig.cmake)
  write_basic_package_version_file(plm_vinsConfigVersion.cmake COMPATIBILITY SameMajorVersion)
  install(FILES ${CMAKE_CURRENT_BINARY_DIR}/plm_vinsConfigVersion.cmake
          DESTINATION ${package_folder})
endif()
