# daumier_embed(TARGET NAMESPACE HEADER_NAME files...): the bytes of files in TARGET, so that the program needs no data folder.
# Makes build/<preset>/embedded/HEADER_NAME with NAMESPACE::EmbeddedFiles(), a map from the stem of each file to its bytes, and an
# object in which the assembler includes them (.incbin): no byte passes through CMake or the compiler, and an edited file is
# assembled again without a new configuration. Of each namespace there can be one. Its names may contain no quote.
function(daumier_embed target namespace header)
  string(REPLACE "::" "_" prefix "${namespace}_${header}")
  set(assembly "// Made by cmake/embed.cmake. Do not edit.\n.section .rodata,\"a\",%progbits\n")
  set(declarations "")
  set(entries "")
  set(stems "")
  set(files "")
  foreach(file ${ARGN})
    get_filename_component(file ${file} ABSOLUTE)
    get_filename_component(stem ${file} NAME_WLE)
    if(stem IN_LIST stems)
      message(FATAL_ERROR "daumier_embed: two files of ${header} have the stem ${stem}")
    endif()
    list(LENGTH stems index)
    list(APPEND stems ${stem})
    list(APPEND files ${file})
    string(MAKE_C_IDENTIFIER "${prefix}_${index}_${stem}" symbol)
    string(APPEND assembly
".balign 16
.globl ${symbol}
.hidden ${symbol}
.type ${symbol}, %object
${symbol}:
.incbin \"${file}\"
1:
.size ${symbol}, 1b - ${symbol}
.balign 8
.globl ${symbol}_size
.hidden ${symbol}_size
.type ${symbol}_size, %object
.size ${symbol}_size, 8
${symbol}_size:
.quad 1b - ${symbol}
")
    string(APPEND declarations "extern const char ${symbol}[];\nextern const uint64_t ${symbol}_size;\n")
    string(APPEND entries "      {\"${stem}\", {${symbol}, ${symbol}_size}},\n")
  endforeach()
  string(APPEND assembly ".section .note.GNU-stack,\"\",%progbits\n")

  set(assembly_file ${PROJECT_BINARY_DIR}/embedded/${header}.S)
  file(GENERATE OUTPUT ${assembly_file} CONTENT "${assembly}")
  set_source_files_properties(${assembly_file} PROPERTIES OBJECT_DEPENDS "${files}")
  target_sources(${target} PRIVATE ${assembly_file})
  file(GENERATE OUTPUT ${PROJECT_BINARY_DIR}/embedded/${header} CONTENT
"#pragma once
// Made by cmake/embed.cmake. Do not edit.
#include <cstdint>
#include <map>
#include <string_view>

extern \"C\" {
${declarations}}

namespace ${namespace} {
/// The bytes of each file by its stem.
inline const std::map<std::string_view, std::string_view>& EmbeddedFiles() {
  static const std::map<std::string_view, std::string_view> files = {
${entries}  };
  return files;
}
}  // namespace ${namespace}
")
endfunction()
