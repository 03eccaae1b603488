# The page of `daumier studio` in the program: bundled by esbuild from studio/page/ with npm's packages, which `./dev setup` installs.
# Without them, as in the preset `try`, the program has no page, and says so.
set(page_folder ${PROJECT_SOURCE_DIR}/studio/page)
set(page_files "")
find_program(NODE node)
if(NODE AND EXISTS ${page_folder}/node_modules/esbuild)
  set(page_out ${PROJECT_BINARY_DIR}/studio_page)
  set(page_files ${page_out}/index.html ${page_out}/page.js ${page_out}/style.css)
  file(GLOB_RECURSE page_sources CONFIGURE_DEPENDS ${page_folder}/src/*.ts ${page_folder}/src/*.css)
  add_custom_command(OUTPUT ${page_files} COMMAND ${NODE} ${page_folder}/build.mjs ${page_out}
                     COMMAND ${CMAKE_COMMAND} -E rename ${page_out}/page.css ${page_out}/style.css  # Stems are different.
                     DEPENDS ${page_sources} ${page_folder}/index.html ${page_folder}/build.mjs ${page_folder}/package-lock.json
                     VERBATIM)
endif()
daumier_embed(daumier_studio daumier::studio studio_page.h ${page_files})

# The page in a browser; skipped where there is none. Browser and server take two processors.
if(BUILD_TESTING AND page_files AND NOT DAUMIER_SANITIZE)
  add_test(NAME studio_page COMMAND ${NODE} ${PROJECT_SOURCE_DIR}/tests/studio/page/smoke.mjs $<TARGET_FILE:daumier>
           WORKING_DIRECTORY ${PROJECT_SOURCE_DIR})
  set_tests_properties(studio_page PROPERTIES SKIP_RETURN_CODE 77 TIMEOUT 120 PROCESSORS 2 LABELS plain)
  add_test(NAME studio_collection COMMAND ${NODE} ${PROJECT_SOURCE_DIR}/tests/studio/page/collection.mjs $<TARGET_FILE:daumier>
           WORKING_DIRECTORY ${PROJECT_SOURCE_DIR})
  set_tests_properties(studio_collection PROPERTIES TIMEOUT 300 PROCESSORS 2 LABELS torch)
endif()
