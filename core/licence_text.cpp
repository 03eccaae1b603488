#include "core/licence_text.h"

#include <fmt/format.h>

#include <set>
#include <string_view>

namespace daumier {
namespace {

constexpr std::string_view kMit = "MIT, (c) ";

constexpr const char* kMitText = R"(MIT License

Copyright (c) {}

Permission is hereby granted, free of charge, to any person obtaining a copy
of this software and associated documentation files (the "Software"), to deal
in the Software without restriction, including without limitation the rights
to use, copy, modify, merge, publish, distribute, sublicense, and/or sell
copies of the Software, and to permit persons to whom the Software is
furnished to do so, subject to the following conditions:

The above copyright notice and this permission notice shall be included in all
copies or substantial portions of the Software.

THE SOFTWARE IS PROVIDED "AS IS", WITHOUT WARRANTY OF ANY KIND, EXPRESS OR
IMPLIED, INCLUDING BUT NOT LIMITED TO THE WARRANTIES OF MERCHANTABILITY,
FITNESS FOR A PARTICULAR PURPOSE AND NONINFRINGEMENT. IN NO EVENT SHALL THE
AUTHORS OR COPYRIGHT HOLDERS BE LIABLE FOR ANY CLAIM, DAMAGES OR OTHER
LIABILITY, WHETHER IN AN ACTION OF CONTRACT, TORT OR OTHERWISE, ARISING FROM,
OUT OF OR IN CONNECTION WITH THE SOFTWARE OR THE USE OR OTHER DEALINGS IN THE
SOFTWARE.
)";

std::string TextIn(const Json& source, const char* key) {
  const auto found = source.find(key);
  return found != source.end() && found->is_string() ? found->get<std::string>() : "unknown";
}

}  // namespace

std::string LicenceNotices(const Json& sources) {
  std::string notices;
  std::set<std::string> listed;
  for (const Json& source : sources) {
    const std::string name = TextIn(source, "name"), licence = TextIn(source, "licence");
    if (!listed.insert(name + '\n' + licence).second) continue;
    if (licence.starts_with(kMit)) {
      notices += fmt::format("{}:\n\n```text\n{}```\n\n", name,
                             fmt::format(fmt::runtime(kMitText), licence.substr(kMit.size())));
    } else {
      notices += fmt::format("{}: {}.\n\n", name, licence);
    }
  }
  return notices;
}

}  // namespace daumier
