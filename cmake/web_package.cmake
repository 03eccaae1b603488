# The npm package of web/: its compiler, its unit tests, and its example in Chromium; `./dev consumers web_package` also compares its
# networks with the program's, which takes a minute and more. Skipped where npm's packages, which
# `./dev setup` installs, or Chromium are missing.
if(BUILD_TESTING AND NODE AND NOT DAUMIER_SANITIZE)
  add_test(NAME web_package COMMAND ${NODE} ${PROJECT_SOURCE_DIR}/tests/web/run.mjs $<TARGET_FILE:daumier> ${PROJECT_BINARY_DIR}/web --quick
           WORKING_DIRECTORY ${PROJECT_SOURCE_DIR})
  set_tests_properties(web_package PROPERTIES SKIP_RETURN_CODE 77 TIMEOUT 600 LABELS plain)
endif()
