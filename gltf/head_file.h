#pragma once
#include "render/image.h"
#include "rig/rigged_head.h"
#include "rig/weights_clip.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace daumier::gltf {

/// Which nodes a .glb has.
enum class HeadNodeNames {
  kDaumier,        ///< Head, LeftEye, RightEye, Jaw.
  kReadyPlayerMe,  ///< The skeleton and the names that players of Ready Player Me's avatars expect.
};

struct HeadFileOptions {
  /// Targets displace normals, too: exact shading, at twice the size.
  bool normals = false;
  /// EXT_meshopt_compression, numbers in steps (glb_builder.h), and the texture as JPEG: a small file for web pages,
  /// which programs without that extension refuse.
  bool compressed = false;
  /// Of the head's pivot over the ground, m: that of an adult.
  double pivot_height_m = 1.55;
  HeadNodeNames nodes = HeadNodeNames::kDaumier;
  /// Of a .vrm, which requires both.
  std::string title = "Head";
  std::vector<std::string> authors = {"Daumier"};
};

/// A binary glTF 2.0 file of a rigged head for game engines, web pages and modelling programs. Metres, y up, the face to
/// +z, the head's own left at +x.
///
/// Attachments are nodes of their names below Head (Wolf3D_NAME of kReadyPlayerMe), with colours at their vertices.
/// Nodes: Head (the mesh Face, about head_pivot, with one primitive and all targets), below it LeftEye and RightEye (the
/// meshes LeftEyeball, RightEyeball, about their centres; identity = straight ahead) and Jaw (no mesh: where parts that
/// follow the jaw are attached; jawOpen moves the skin by itself). Targets are dense float32, of positions alone or of
/// positions and normals; displacements below 1e-6 m are 0. Names are in mesh.extras.targetNames; default weights are 0.
/// Vertices that no triangle uses are left out; those at seams of UV occur once a side, with the normal of the unsplit
/// surface.
///
/// What triangles show is stated in `extras.triangles` of Head and eyes (triangle_runs.h), unless the file is compressed.
///
/// Materials of its own (RiggedHead::own_materials): a mesh a material. That which moves most is Face, others are Face_NAME
/// at the nodes Head_NAME below Head, with all targets if any of their vertices moves; eyes likewise.
///
/// kReadyPlayerMe: root Armature, below it the 52 bones that TalkingHead requires with LeftEye, RightEye and HeadTop_End, as
/// nodes in a T-pose (RpmSkeleton); below the bone Head the meshes Wolf3D_Head and Wolf3D_Teeth, below the bones of the eyes
/// EyeLeft and EyeRight. All have all targets; those named eyeLook* and eyesLook* turn the eyes by 30 degrees, so the
/// animation does not turn their bones. A triangle of 0.1 mm on the ground lets players measure the height.
///
/// `texture`: the atlas; without it vertices are coloured by their material. `clip`: a single animation of weights, head
/// and eyes, linear, 0 .. 1, which begins with the neutral pose (ResolveClip); absent: rig::DemoClip; without frames:
/// none. Licence and source are in the file's `asset`. Equal input gives equal bytes.
///
/// @throws Error if the head is no valid one: sizes that disagree, a vertex or displacement in use that is not finite,
/// names of targets that are empty, equal but for case, or not of letters, digits and "_", a number of eyes other than 0
/// or 2, eyes in the wrong order; if a texture is given for a mesh without UV; or as ResolveClip.
std::string HeadToGlb(const rig::RiggedHead& head, const render::Image* texture,
                      const std::optional<rig::WeightsClip>& clip, const HeadFileOptions& options = {});

/// A VRM 1.0 file: the same head on a skeleton without a body (the 15 bones that VRM requires, as nodes), with
/// expressions: the presets of VRM whose targets the head has, and one custom expression a target, named as the target in
/// PascalCase ("perfect sync"). The gaze turns the eyes by up to 30 degrees. No animation, which VRM does not
/// use. @throws Error as HeadToGlb; if the title, the authors or a name among them is empty; if the head has no eyes.
std::string HeadToVrm(const rig::RiggedHead& head, const render::Image* texture, const HeadFileOptions& options = {});

/// HeadToGlb or HeadToVrm by the extension (".glb", ".vrm"), atomic. @throws UsageError on another extension; Error as
/// these, or naming the file and the cause; nothing is left behind then.
void WriteHead(const std::filesystem::path& path, const rig::RiggedHead& head, const render::Image* texture,
               const std::optional<rig::WeightsClip>& clip, const HeadFileOptions& options = {});

}  // namespace daumier::gltf
