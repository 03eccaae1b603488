# daumier_embed(NAMESPACE HEADER_NAME files...): C++ constants of text files, so that the program needs no data folder.
# Makes build/<preset>/embedded/HEADER_NAME with a function that returns the text of a file by its stem.
function(daumier_embed namespace header)
  set(entries "")
  foreach(file ${ARGN})
    set_property(DIRECTORY ${PROJECT_SOURCE_DIR} APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${file})
    get_filename_component(stem ${file} NAME_WLE)
    file(READ ${file} text)
    string(APPEND entries "    {\"${stem}\", R\"embedded(${text})embedded\"},\n")
  endforeach()
  file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/embedded/${header} @ONLY CONTENT
"#pragma once
// Made by cmake/embed.cmake. Do not edit.
#include <map>
#include <string_view>

namespace @namespace@ {
inline const std::map<std::string_view, std::string_view>& EmbeddedFiles() {
  static const std::map<std::string_view, std::string_view> files = {
@entries@  };
  return files;
}
}  // namespace @namespace@
")
endfunction()
