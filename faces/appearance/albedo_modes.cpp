#include "faces/appearance/albedo_modes.h"

namespace daumier::faces {

const std::vector<AlbedoModeSpec>& NamedAlbedoModes() {
  static const std::vector<AlbedoModeSpec> modes = {
      // The whole skin.
      {"melanin", "skin", kMelaninStep},
      {"haemoglobin", "skin", kHaemoglobinStep},
      {"warmth", "skin", kWarmthStep},
      // Lips.
      {"lips_red", "lips", {0.038f, -0.056f, -0.038f}},
      {"lips_lightness", "lips", {0.033f, 0.033f, 0.033f}},
      {"lips_purple", "lips", {-0.012f, -0.018f, 0.030f}},
      {"upper_lip_lightness", "upper_lip", {0.024f, 0.021f, 0.021f}},
      {"lower_lip_lightness", "lower_lip", {0.027f, 0.024f, 0.024f}},
      // Brows.
      {"brows_darkness", "brows", {-0.070f, -0.070f, -0.065f}},
      {"brows_redness", "brows", {0.040f, 0.000f, -0.025f}},
      {"brows_thickness", "brow_rims", {-0.055f, -0.055f, -0.050f}},
      {"brows_taper", "brows_along", {-0.045f, -0.045f, -0.040f}},
      {"glabella_darkness", "glabella", {-0.021f, -0.022f, -0.021f}},
      // Around the eyes.
      {"upper_lid_darkness", "upper_lids", {-0.036f, -0.039f, -0.036f}},
      {"upper_lid_blue", "upper_lids", {-0.025f, -0.005f, 0.032f}},
      {"upper_lid_pink", "upper_lids", {0.022f, -0.020f, 0.005f}},
      {"lower_lid_darkness", "lower_lids", {-0.028f, -0.032f, -0.025f}},
      {"lid_line", "lid_edges", {-0.110f, -0.110f, -0.100f}},
      {"socket_darkness", "sockets", {-0.021f, -0.024f, -0.021f}},
      // Cheeks.
      {"blush", "cheeks", {0.022f, -0.028f, -0.015f}},
      {"blush_orange", "cheeks", {0.016f, -0.004f, -0.020f}},
      {"cheekbone_lightness", "cheekbones", {0.030f, 0.030f, 0.028f}},
      {"hollow_darkness", "hollows", {-0.021f, -0.023f, -0.019f}},
      // Nose, ears, forehead, chin.
      {"nose_red", "nose_tip", {0.022f, -0.025f, -0.018f}},
      {"nose_bridge_lightness", "nose_bridge", {0.032f, 0.032f, 0.030f}},
      {"ears_red", "ears", {0.022f, -0.020f, -0.015f}},
      {"forehead_lightness", "forehead", {0.030f, 0.030f, 0.028f}},
      {"chin_red", "chin", {0.015f, -0.015f, -0.011f}},
      // Hair under the skin.
      {"beard_shadow", "beard", {-0.042f, -0.032f, -0.021f}},
      {"beard_red", "beard", {0.007f, -0.010f, -0.018f}},
      {"moustache_shadow", "moustache", {-0.027f, -0.024f, -0.019f}},
      {"scalp_shadow", "scalp", {-0.033f, -0.029f, -0.024f}},
      {"neck_darkness", "neck", {-0.021f, -0.022f, -0.019f}},
      // Spots and sun.
      {"freckles", "freckles", {-0.040f, -0.052f, -0.050f}},
      {"fine_freckles", "fine_freckles", {-0.035f, -0.045f, -0.042f}},
      {"sun", "sun", {0.006f, -0.024f, -0.021f}},
      // Age.
      {"nasolabial_lines", "nasolabial", {-0.055f, -0.060f, -0.050f}},
      {"forehead_lines", "forehead_lines", {-0.036f, -0.038f, -0.034f}},
      {"eye_bags", "eye_bags", {-0.045f, -0.055f, -0.030f}},
      {"nostril_darkness", "nostrils", {-0.070f, -0.070f, -0.060f}},
  };
  return modes;
}

const std::vector<AlbedoModeSpec>& MeanAlbedoParts() {
  static const std::vector<AlbedoModeSpec> parts = {
      {"lips", "lips", {0.000f, -0.150f, -0.095f}},        {"brows", "brows", {-0.160f, -0.140f, -0.110f}},
      {"cheeks", "cheeks", {0.030f, -0.030f, -0.015f}},    {"nose", "nose_tip", {0.020f, -0.025f, -0.015f}},
      {"ears", "ears", {0.015f, -0.030f, -0.020f}},        {"lids", "upper_lids", {-0.030f, -0.045f, -0.035f}},
      {"edges", "lid_edges", {-0.090f, -0.100f, -0.085f}}, {"nostrils", "nostrils", {-0.220f, -0.210f, -0.180f}},
  };
  return parts;
}

}  // namespace daumier::faces
