#pragma once
#include "core/task.h"
#include "datasets/read/portrait_database.h"

#include <filesystem>
#include <vector>

namespace daumier::datasets {

/// The truth of a portrait drawn over it: classes of the mask in colours, and a dot at each landmark, light where it is
/// seen and dark where it is hidden.
render::Image PortraitTruth(const PortraitDatabase& database, int i);

/// @throws UsageError if `out` is neither empty nor an earlier gallery, or a picture in it would be lost.
void CheckPortraitGalleryFolder(const std::filesystem::path& out, const std::vector<std::filesystem::path>& inputs);

/// Sheets of the first 64 portraits by index, never picked ones, into an existing folder, and a manifest (kind
/// "gallery"):
///   portraits.jpg        the pictures
///   portrait_truth.jpg   the same with their masks and landmarks
/// @throws Error if a picture cannot be written; Cancelled, between pictures, if the task is.
void WritePortraitGallery(const PortraitDatabase& database, const std::filesystem::path& folder, const Task& task = {});

}  // namespace daumier::datasets
