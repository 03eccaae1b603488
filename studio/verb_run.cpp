#include "studio/verb_run.h"

#include "core/child_process.h"
#include "core/error.h"
#include "studio/job_queue.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <set>

namespace daumier::studio {
namespace {

namespace fs = std::filesystem;

/// A word of a command line as a shell reads it.
std::string Quoted(const std::string& word) {
  const auto is_plain = [](unsigned char c) {
    return std::isalnum(c) || std::string_view("._-/=,:+%@").find(char(c)) != std::string_view::npos;
  };
  if (!word.empty() && std::ranges::all_of(word, is_plain)) return word;
  std::string quoted = "'";
  for (const char c : word) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

}  // namespace

void VerbRun::Add(const std::string& option, const std::string& value) {
  words_.push_back(option);
  words_.push_back(value);
}

void VerbRun::AddFlag(const std::string& flag, bool is_set) {
  if (is_set) words_.push_back(flag);
}

std::string VerbRun::CommandLine() const {
  std::vector<std::string> quoted;
  for (const std::string& word : words_) quoted.push_back(Quoted(word));
  return fmt::format("daumier {}", fmt::join(quoted, " "));
}

std::string VerbRun::Run(const fs::path& program, const fs::path& folder, const fs::path& scratch,
                         const Task& task) const {
  std::vector<std::string> arguments = {program.string()};
  arguments.insert(arguments.end(), words_.begin(), words_.end());
  const auto child = RunChild(arguments, scratch, {.folder = folder, .task = task});
  DAUMIER_CHECK(child.has_value(), "{} is not there any more. Start the studio again", program.string());
  if (child->exit_code == 0) return child->out;
  std::string why = ProgressOf(scratch);  // Its last line.
  for (const std::string_view prefix : {"daumier: ", "error: "})
    if (why.starts_with(prefix)) why = why.substr(prefix.size());
  throw Error(why.empty() ? "the program ended without a result" : why);
}

std::string NameOfCopy(const fs::path& file) {
  static const std::set<std::string> written = {"head", "stages", "landmarks", "predicted", "face", "drawing"};
  const std::string name = file.filename().string();
  return written.contains(file.stem().string()) ? "input_" + name : name;
}

void CopyInto(const fs::path& folder, const fs::path& file) {
  fs::copy_file(file, folder / NameOfCopy(file), fs::copy_options::overwrite_existing);
}

}  // namespace daumier::studio
