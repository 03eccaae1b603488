#include "gltf/head_file.h"

#include "core/error.h"
#include "core/files.h"
#include "gltf/head_document.h"
#include "rig/demo_clip.h"

namespace daumier::gltf {

std::string HeadToGlb(const rig::RiggedHead& head, const render::Image* texture,
                      const std::optional<rig::WeightsClip>& clip, const HeadFileOptions& options) {
  CheckHead(head, texture);
  const HeadAnimation animation = ResolveClip(clip ? *clip : rig::DemoClip(head.targets.names), head.targets.names);
  GlbBuilder builder(options.compressed ? GlbEncoding::kMeshopt : GlbEncoding::kPlain);
  AddAsset(builder, head);
  if (options.nodes == HeadNodeNames::kReadyPlayerMe) {
    AddReadyPlayerMeHead(builder, head, texture, animation, options);
    return builder.Finish();
  }
  const HeadNodes nodes = AddHead(builder, head, texture, options, options.pivot_height_m);
  AddAnimation(builder, nodes, animation);
  builder.json()["scenes"] = Json::array({{{"nodes", {nodes.head}}}});
  builder.json()["scene"] = 0;
  return builder.Finish();
}

void WriteHead(const std::filesystem::path& path, const rig::RiggedHead& head, const render::Image* texture,
               const std::optional<rig::WeightsClip>& clip, const HeadFileOptions& options) {
  const std::string extension = path.extension().string();
  if (extension == ".vrm") {
    WriteFileAtomically(path, HeadToVrm(head, texture, options));
  } else if (extension == ".glb") {
    WriteFileAtomically(path, HeadToGlb(head, texture, clip, options));
  } else {
    throw UsageError(fmt::format("{}: heads are written as .glb or .vrm, not as '{}'", path.string(), extension));
  }
}

}  // namespace daumier::gltf
