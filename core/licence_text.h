#pragma once
#include "core/json.h"

#include <string>

namespace daumier {

/// The notices of the sources of a manifest ([{name, licence, ...}]) in Markdown: the whole text for the MIT licence
/// ("MIT, (c) 2020 HOLDER"), which has to be passed on with what is made of the source; of other licences the line of
/// the manifest. A source that occurs twice is listed once.
std::string LicenceNotices(const Json& sources);

}  // namespace daumier
