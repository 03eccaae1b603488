#include "rig/clip_files.h"

#include "core/files.h"
#include "rig/clip_csv.h"
#include "rig/clip_json.h"

namespace daumier::rig {

Recording ReadClip(const std::filesystem::path& path) {
  const std::string text = ReadFile(path);
  const size_t begin = text.find_first_not_of("\xEF\xBB\xBF \t\r\n");
  const bool is_json = begin != std::string::npos && (text[begin] == '{' || text[begin] == '[');
  return is_json ? ParseClipJson(text, path.string()) : ParseClipCsv(text, path.string());
}

}  // namespace daumier::rig
