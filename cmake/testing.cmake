# The target `tests` builds all tests and the programs that they run; `run_tests`, which catkin has,
# runs them. An ordinary build compiles no test.
enable_testing()
if(NOT TARGET tests)  # catkin defines it
  add_custom_target(tests)
endif()
if(TARGET run_tests)
  add_custom_target(run_tests_${PROJECT_NAME}_ctest COMMAND ${CMAKE_CTEST_COMMAND} --output-on-failure
                    WORKING_DIRECTORY ${PROJECT_BINARY_DIR})
  add_dependencies(run_tests_${PROJECT_NAME}_ctest tests)
  add_dependencies(run_tests run_tests_${PROJECT_NAME}_ctest)
endif()
# catkin_test_results looks for results here.
set(PLM_TEST_RESULTS ${CMAKE_BINARY_DIR}/test_results/${PROJECT_NAME})
