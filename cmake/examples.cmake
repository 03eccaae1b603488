# The worked examples of docs/extending, one binary of tests. docs/examples/extending/ is laid out as the source tree, and its
# files are included by the paths that they will have there; tools/check_extending compares them with the pages.
function(daumier_extending_tests)
  if(NOT DAUMIER_TRAINING OR NOT BUILD_TESTING OR DAUMIER_SANITIZE)
    return()
  endif()
  set(folder ${PROJECT_SOURCE_DIR}/docs/examples/extending)
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${folder}/*.cpp)
  if(NOT sources)
    return()  # Of an extended tree (tools/check_extending --keep), where they have moved to their places.
  endif()
  add_executable(daumier_extending_tests ${sources})
  daumier_program(daumier_extending_tests)
  daumier_batches(daumier_extending_tests 7)
  target_precompile_headers(daumier_extending_tests REUSE_FROM daumier_pch_torch)
  target_compile_options(daumier_extending_tests PRIVATE "SHELL:-iquote ${folder}")
  target_link_libraries(daumier_extending_tests PRIVATE daumier_startup daumier_test_main daumier_test_support
                        daumier_systems_sketch_train archive_writers GTest::gtest)
  add_test(NAME extending COMMAND daumier_extending_tests WORKING_DIRECTORY ${PROJECT_SOURCE_DIR})
  set_tests_properties(extending PROPERTIES TIMEOUT 600 LABELS torch)
endfunction()

# The example of the renderer as a library of its own, built here from the source tree: its program ends with 0 if it found the
# pose. `daumier/raster/camera.h`, as an installed tree has it, is found through a link.
function(daumier_fit_pose_test)
  if(NOT BUILD_TESTING OR DAUMIER_SANITIZE)
    return()
  endif()
  set(include ${PROJECT_BINARY_DIR}/examples_include)
  file(MAKE_DIRECTORY ${include})
  file(CREATE_LINK ${PROJECT_SOURCE_DIR} ${include}/daumier SYMBOLIC)
  add_executable(daumier_fit_pose ${PROJECT_SOURCE_DIR}/docs/examples/fit_pose.cpp)
  target_include_directories(daumier_fit_pose PRIVATE ${include})
  target_link_libraries(daumier_fit_pose PRIVATE daumier_raster)
  add_test(NAME fit_pose COMMAND daumier_fit_pose)
  set_tests_properties(fit_pose PROPERTIES TIMEOUT 60 LABELS plain)
endfunction()
