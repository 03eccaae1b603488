#pragma once
#include "systems/shipped_weights.h"

#include <filesystem>
#include <string>
#include <vector>

namespace daumier::c_api {

/// The tasks that predict.
const std::vector<systems::System>& Predictors();

/// A folder that holds a manifest, or the shipped weights of a name. @throws UsageError listing what is there.
std::filesystem::path FolderNamed(const char* name);

/// FolderNamed, or the first shipped face model where the name is NULL. @throws UsageError also if there is none.
std::filesystem::path ModelNamed(const char* name);

/// ModelNamed that is weights of a face model. @throws UsageError if it is something else.
std::filesystem::path FaceModelNamed(const char* name);

}  // namespace daumier::c_api
