#pragma once
#include "core/options.h"
#include "core/random.h"
#include "faces/controls/control_fit.h"
#include "faces/exaggeration.h"
#include "faces/openings.h"

#include <vector>

namespace daumier::faces {

struct CaricatureOptions {
  std::vector<double> amounts = {0.0, 1.0, 2.0, 3.0};
  double own = 0.9;
  double emphasis = 0.4;
  double group_spread = 0.5;
  double invention = 0.3;
  double looseness = 1.0;
  double tendencies = 1.0;
  double asymmetry = 0.15;
  double inconsistent = 0.2;
  double crispness = 0.02;

  template <class V>
  void Visit(V&& visit) {
    visit("amounts", amounts, Range{0.0, 10.0}, "Amount of caricature, one for each level; the first is 0.");
    visit("own", own, Range{0.0, 5.0},
          "Multiple of the person's own deviation from the mean that an amount of 1 adds.");
    visit("emphasis", emphasis, Range{0.0, 2.0},
          "A control that deviates z times as far as usual is exaggerated z^emphasis times as strongly.");
    visit("group_spread", group_spread, Range{0.0, 2.0},
          "Standard deviation of the logarithm of the strength of each group of controls.");
    visit("invention", invention, Range{0.0, 3.0},
          "Standard deviation of the control values that do not come from the person, for an amount of 1.");
    visit("looseness", looseness, Range{0.0, 10.0},
          "Strength of smooth warps of the whole head, as a multiple of `invention`.");
    visit("tendencies", tendencies, Range{0.0, 5.0},
          "Strength of the traits that most caricatures share, such as long chins.");
    visit("asymmetry", asymmetry, Range{0.0, 1.0},
          "Strength of differences between left and right and of sideways controls, as a multiple of `invention`.");
    visit("inconsistent", inconsistent, Range{0.0, 1.0},
          "Share of caricatures whose groups of controls are exaggerated independently of each other, some reversed.");
    visit("crispness", crispness, Range{0.0, 0.2},
          "Exponent of curvature (see exaggeration.gammas) for an amount of 1: details become sharper.");
  }
};

/// Draws caricatures of persons as artists do: what distinguishes a person from the mean is exaggerated [Brennan 1985],
/// part by part, together with some invention. For a person whose controls deviate from the mean by values u
/// (ControlFit), with z = u / deviations, a caricature of amount a has the values
///   v_k = 3 tanh(a T (b_k (G_g own u_k max(|z_k|, 1/2)^emphasis + invention R_k) + tendencies t_k) / 3)
/// with T = exp(0.25 n) the strength of the whole, G_g = exp(group_spread n_g) that of the group g of k, n and n_g of a
/// normal distribution cut at two deviations, b_k and t_k the boldness and tendency of the control (ArtistHabit), and
/// R_k = sum_j q_kj s_j + 0.5 s_g + 0.7 s_k, q_k the control's share of three types of heads (ArtistHabit::types), where
/// s are of Student's t distribution with four degrees of freedom and a variance of 1, cut at 3: types and groups move
/// together. In a share of caricatures (`inconsistent`) G_g is uniform in [-0.5, 2.5]. Smooth warps (SmoothWarps) have
/// looseness s_k for R_k. A pair has
/// the same s_k left and right, up to asymmetry.
class CaricatureGenerator {
 public:
  /// @throws Error as ControlFit, FindOpenings and RegionFor; UsageError unless the first amount is 0.
  CaricatureGenerator(const FaceTemplate& face_template, const std::vector<geometry::Points>& population,
                      CaricatureOptions options, ExaggerationOptions exaggeration,
                      std::vector<GivenControl> given = {});

  /// num_values: the values of a caricature; an amount of 0 gives 0.
  Eigen::VectorXd DrawValues(const geometry::Points& neutral, double amount, Rng& rng) const;

  struct Caricature {
    geometry::Points face;   ///< V x 3, cm.
    Eigen::VectorXd values;  ///< num_values: those applied, after corrections.
  };
  /// The neutral face (V x 3, cm), its curvature but for the mouth's exaggerated by amount * crispness
  /// (faces::Exaggerate), with the controls applied, similarity-aligned to the face it came from by the 68 landmarks,
  /// those of the contour with a tenth of the others' weight (as registered faces are). Controls that move a triangle of
  /// the face whose normal turns by more than 90 degrees, or the lips apart where these cross by 0.1 mm more than the
  /// neutral face's, are reduced by a fifth, again and again.
  /// Promises: values of 0 and an amount of 0 return the face; no triangle of the face flips.
  Caricature Make(const geometry::Points& neutral, double amount, Eigen::VectorXd values) const;

  const FaceControls& controls() const { return controls_; }
  const ControlFit& fit() const { return fit_; }
  const CaricatureOptions& options() const { return options_; }

 private:
  geometry::Points Sharpened(const geometry::Points& neutral, double amount) const;
  /// Those that have to be smaller, since triangles flip or lips cross; none if all is well.
  std::vector<int> ValuesToReduce(const geometry::Points& neutral, const geometry::Points& made, int round) const;

  FaceTemplate face_template_;
  CaricatureOptions options_;
  ExaggerationOptions exaggeration_;
  FaceControls controls_;
  ControlFit fit_;
  FaceOpenings openings_;
  Eigen::VectorXd mouth_;  ///< V: 1 at the mouth.
};

}  // namespace daumier::faces
