#pragma once
#include "core/options.h"
#include "core/random.h"

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace daumier::faces {

enum class HairStyle { kBald, kShort, kBob, kLong, kBun, kPonytail, kSpiky, kCurly, kParted, kFringe, kReceding };
inline constexpr std::array<const char*, 11> kHairStyleNames = {
    "bald", "short", "bob", "long", "bun", "ponytail", "spiky", "curly", "parted", "fringe", "receding"};
enum class BeardStyle { kNone, kMoustache, kGoatee, kFull, kLong, kChinStrap };
inline constexpr std::array<const char*, 6> kBeardStyleNames = {"none", "moustache", "goatee",
                                                                "full", "long",      "chin_strap"};
enum class HatStyle { kNone, kCap, kBeanie, kBrimmed };
inline constexpr std::array<const char*, 4> kHatStyleNames = {"none", "cap", "beanie", "brimmed"};
enum class GlassesStyle { kNone, kRound, kSquare, kDark };
inline constexpr std::array<const char*, 4> kGlassesStyleNames = {"none", "round", "square", "dark"};
enum class CollarStyle { kRound, kHigh, kOpen };
inline constexpr std::array<const char*, 3> kCollarStyleNames = {"round", "high", "open"};

/// All that a portrait shows of a person but shape, pose and light. Colours are display RGB in [0, 1]. Lengths without a
/// unit are multiples of what is usual.
struct Looks {
  Eigen::VectorXf albedo;  ///< kNumAlbedoModes coefficients of AlbedoBasis; age is a part of them.

  HairStyle hair = HairStyle::kShort;
  Eigen::Vector3f hair_colour{0.25f, 0.16f, 0.10f};
  double hair_volume = 1.0;   ///< 0.6 .. 1.6
  double hair_length = 1.0;   ///< 0.6 .. 1.5
  double hair_fringe = 0.0;   ///< 0: none, 1: down to the brows.
  double hair_parting = 0.0;  ///< -1 (own right) .. 1: where the fringe is parted or swept to.

  Eigen::Vector3f brow_colour{0.25f, 0.16f, 0.10f};
  double brow_thickness = 1.0;  ///< 0.5 .. 1.8
  double brow_arch = 0.0;       ///< -1 .. 1
  double lash_length = 1.0;     ///< 0: none; 0.6 .. 2
  double lid_line = 0.0;        ///< 0 .. 1: a drawn line along the upper lid.

  Eigen::Vector3f iris_colour{0.36f, 0.22f, 0.11f};
  double iris_size = 1.0, pupil_size = 1.0;  ///< 0.8 .. 1.4, 0.7 .. 1.4
  double gaze_yaw = 0.0, gaze_pitch = 0.0;   ///< Radians; to the face's own left and upwards. At most 0.5.
  int highlights = 1;                        ///< White spots on each eye: 0, 1, 2.

  BeardStyle beard = BeardStyle::kNone;
  Eigen::Vector3f beard_colour{0.25f, 0.16f, 0.10f};
  double beard_length = 1.0;

  HatStyle hat = HatStyle::kNone;
  Eigen::Vector3f hat_colour{0.7f, 0.2f, 0.2f}, hat_band{0.2f, 0.2f, 0.2f};
  GlassesStyle glasses = GlassesStyle::kNone;
  Eigen::Vector3f glasses_colour{0.1f, 0.1f, 0.1f};

  CollarStyle collar = CollarStyle::kRound;
  Eigen::Vector3f clothes_colour{0.3f, 0.35f, 0.5f};

  double age = 0.3;          ///< 0 (child) .. 1 (old): grey hair; its lines are albedo modes.
  uint64_t detail_seed = 0;  ///< Of waves, curls and spikes.
};

/// Shares of what DrawLooks draws. Occluders are independent of each other and of the skin.
struct LooksOptions {
  double bald = 0.07, hats = 0.12, glasses = 0.15, dark_glasses = 0.25, beards = 0.2, unnatural_hair = 0.12, old = 0.2,
         makeup = 0.3, gaze = 0.6, even_tones = 0.5;

  template <class V>
  void Visit(V&& visit) {
    visit("bald", bald, Range{0.0, 1.0}, "Share of heads without hair.");
    visit("hats", hats, Range{0.0, 1.0}, "Share of heads with a cap, a beanie or a brimmed hat.");
    visit("glasses", glasses, Range{0.0, 1.0}, "Share of heads with glasses.");
    visit("dark_glasses", dark_glasses, Range{0.0, 1.0}, "Share of glasses that hide the eyes.");
    visit("beards", beards, Range{0.0, 1.0}, "Share of heads with a beard or moustache.");
    visit("unnatural_hair", unnatural_hair, Range{0.0, 1.0}, "Share of hair in blue, pink, green and the like.");
    visit("old", old, Range{0.0, 1.0}, "Share of old people: grey hair, lines, bags under the eyes.");
    visit("makeup", makeup, Range{0.0, 1.0}, "Share of faces with strong lips, blush or lid colour.");
    visit("gaze", gaze, Range{0.0, 1.0}, "Share of eyes that do not look straight ahead.");
    visit("even_tones", even_tones, Range{0.0, 1.0},
          "Share of heads whose skin tone is drawn evenly from six; that of the others follows the normal distribution "
          "of the melanin coefficient.");
  }
};

Looks DrawLooks(Rng& rng, const LooksOptions& options = {});

}  // namespace daumier::faces
