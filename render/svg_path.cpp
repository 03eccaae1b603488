#include "render/svg_path.h"

#include "core/error.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>

namespace daumier::render {
namespace {

using Eigen::Vector2d;

/// A damaged file can contain curves of any size.
constexpr double kMaxChords = 4096;

int NumChords(double wanted) {
  return static_cast<int>(std::clamp(std::ceil(wanted), 1.0, kMaxChords));
}

bool IsSpace(char c) {
  return c == ' ' || c == '\t' || c == '\n' || c == '\r' || c == '\f';
}

bool IsDigit(char c) {
  return c >= '0' && c <= '9';
}

/// An ellipse's arc by its centre: point(angle) = centre + R(rotation) (rx cos angle, ry sin angle).
struct CentreArc {
  Vector2d centre, radii;
  double rotation, first_angle, sweep_angle;

  Vector2d At(double angle) const {
    return centre + Eigen::Rotation2Dd(rotation) * Vector2d(radii.x() * std::cos(angle), radii.y() * std::sin(angle));
  }
};

struct EndpointArc {
  Vector2d from, to, radii;
  double rotation;  ///< Radians.
  bool large, sweep;
};

/// [SVG 1.1, F.6.5 and F.6.6]: radii that are too small for the end points are made larger.
CentreArc ToCentreArc(const EndpointArc& arc) {
  const Vector2d half = Eigen::Rotation2Dd(-arc.rotation) * (0.5 * (arc.from - arc.to));
  Vector2d radii = arc.radii.cwiseAbs();
  const double excess = half.cwiseQuotient(radii).squaredNorm();
  if (excess > 1.0) radii *= std::sqrt(excess);
  const Vector2d unit_half = half.cwiseQuotient(radii);
  const double offset =
      std::sqrt(std::max(0.0, 1.0 / unit_half.squaredNorm() - 1.0)) * (arc.large == arc.sweep ? -1 : 1);
  const Vector2d unit_centre = offset * Vector2d(unit_half.y(), -unit_half.x());

  const Vector2d first = unit_half - unit_centre, last = -unit_half - unit_centre;
  const double first_angle = std::atan2(first.y(), first.x());
  double sweep_angle = std::atan2(last.y(), last.x()) - first_angle;
  if (arc.sweep && sweep_angle < 0) sweep_angle += 2 * std::numbers::pi;
  if (!arc.sweep && sweep_angle > 0) sweep_angle -= 2 * std::numbers::pi;
  const Vector2d centre =
      Eigen::Rotation2Dd(arc.rotation) * radii.cwiseProduct(unit_centre) + 0.5 * (arc.from + arc.to);
  return {centre, radii, arc.rotation, first_angle, sweep_angle};
}

class PathParser {
 public:
  PathParser(std::string_view data, double tolerance) : numbers_(data), tolerance_(tolerance) {}

  SvgPath Parse() {
    SvgPath path;
    try {
      ReadCommands();
    } catch (const Error& error) {
      path.error = error.what();
    }
    EndSubpath();
    path.polylines = std::move(polylines_);
    return path;
  }

 private:
  void ReadCommands() {
    numbers_.SkipSeparators();
    while (!numbers_.AtEnd()) {
      const size_t position = numbers_.position();
      const char command = numbers_.Take();
      const bool relative = command >= 'a';
      const char upper = static_cast<char>(relative ? command - 'a' + 'A' : command);
      DAUMIER_CHECK(std::string_view("MLHVCSQTAZ").find(upper) != std::string_view::npos,
                    "position {}: '{}' is not a command of path data", position, command);
      DAUMIER_CHECK(upper == 'M' || begun_, "position {}: path data begin with '{}', expected M", position, command);
      Run(upper, relative);
    }
  }

  void Run(char command, bool relative) {
    if (command == 'Z') {
      Close();
      numbers_.SkipSeparators();
      return;
    }
    bool first = true;
    do {
      numbers_.SkipSeparators();
      const Vector2d origin = relative ? point_ : Vector2d(0, 0);
      // What follows a moveto's first point are linetos.
      Segment(command == 'M' && !first ? 'L' : command, origin);
      first = false;
      numbers_.SkipSeparators();
    } while (!numbers_.AtEnd() && numbers_.AtNumber());
  }

  void Segment(char command, const Vector2d& origin) {
    std::optional<Vector2d> cubic_control, quadratic_control;
    switch (command) {
      case 'M':
        EndSubpath();
        start_ = point_ = Point(origin);
        begun_ = true;
        break;
      case 'L':
        LineTo(Point(origin));
        break;
      case 'H':
        LineTo({origin.x() + Number(), point_.y()});
        break;
      case 'V':
        LineTo({point_.x(), origin.y() + Number()});
        break;
      case 'C':
      case 'S': {
        const Vector2d first = command == 'C' ? Point(origin) : Reflected(cubic_control_);
        cubic_control = Point(origin);
        CubicTo(first, *cubic_control, Point(origin));
        break;
      }
      case 'Q':
      case 'T':
        quadratic_control = command == 'Q' ? Point(origin) : Reflected(quadratic_control_);
        QuadraticTo(*quadratic_control, Point(origin));
        break;
      default:
        ArcTo(origin);
    }
    cubic_control_ = cubic_control;
    quadratic_control_ = quadratic_control;
  }

  double Number() {
    numbers_.SkipSeparators();
    return numbers_.Number();
  }

  Vector2d Point(const Vector2d& origin) {
    const double x = Number();
    return origin + Vector2d(x, Number());
  }

  Vector2d Reflected(const std::optional<Vector2d>& control) const {
    return control ? Vector2d(2.0 * point_ - *control) : point_;
  }

  void Append(const Vector2d& point) {
    DAUMIER_CHECK(point.allFinite(), "position {}: a point is not finite", numbers_.position());
    if (current_.points.empty()) current_.points.push_back(point_);
    current_.points.push_back(point);
  }

  void LineTo(const Vector2d& to) {
    Append(to);
    point_ = to;
  }

  /// n equal steps of the parameter leave a curve of degree d by at most d (d - 1) / 8 max|second difference| / n^2
  /// [Wang 1984].
  void CubicTo(const Vector2d& a, const Vector2d& b, const Vector2d& to) {
    const Vector2d from = point_;
    const double bend = std::max((from - 2.0 * a + b).norm(), (a - 2.0 * b + to).norm());
    const int num_chords = NumChords(std::sqrt(0.75 * bend / tolerance_));
    for (int i = 1; i < num_chords; ++i) {
      const double t = static_cast<double>(i) / num_chords, s = 1.0 - t;
      Append(s * s * s * from + 3.0 * s * s * t * a + 3.0 * s * t * t * b + t * t * t * to);
    }
    LineTo(to);
  }

  void QuadraticTo(const Vector2d& control, const Vector2d& to) {
    const Vector2d from = point_;
    const int num_chords = NumChords(std::sqrt(0.25 * (from - 2.0 * control + to).norm() / tolerance_));
    for (int i = 1; i < num_chords; ++i) {
      const double t = static_cast<double>(i) / num_chords, s = 1.0 - t;
      Append(s * s * from + 2.0 * s * t * control + t * t * to);
    }
    LineTo(to);
  }

  void ArcTo(const Vector2d& origin) {
    EndpointArc arc{};
    arc.from = point_;
    arc.radii = Point(Vector2d(0, 0));
    arc.rotation = Number() * std::numbers::pi / 180.0;
    numbers_.SkipSeparators();
    arc.large = numbers_.Flag();
    numbers_.SkipSeparators();
    arc.sweep = numbers_.Flag();
    arc.to = Point(origin);
    if (arc.from == arc.to || arc.radii.x() == 0.0 || arc.radii.y() == 0.0) return LineTo(arc.to);

    const CentreArc centre_arc = ToCentreArc(arc);
    // The sagitta of a chord over an angle a of a circle of radius r is r (1 - cos(a / 2)).
    const double cosine = 1.0 - std::min(1.0, tolerance_ / centre_arc.radii.maxCoeff());
    const int num_chords = NumChords(std::abs(centre_arc.sweep_angle) / (2.0 * std::acos(cosine)));
    for (int i = 1; i < num_chords; ++i) {
      Append(centre_arc.At(centre_arc.first_angle + centre_arc.sweep_angle * i / num_chords));
    }
    LineTo(arc.to);
  }

  void Close() {
    if (current_.points.empty() || current_.points.back() != start_) Append(start_);
    EndSubpath();
    point_ = start_;
    cubic_control_.reset();
    quadratic_control_.reset();
  }

  void EndSubpath() {
    auto& points = current_.points;
    if (points.empty()) return;
    if (std::all_of(points.begin(), points.end(), [&](const Vector2d& point) { return point == points[0]; })) {
      points.resize(1);
    }
    polylines_.push_back(std::move(current_));
    current_ = {};
  }

  SvgNumbers numbers_;
  double tolerance_;
  bool begun_ = false;
  Vector2d start_ = Vector2d::Zero(), point_ = Vector2d::Zero();
  std::optional<Vector2d> cubic_control_, quadratic_control_;
  SvgPolyline current_;
  std::vector<SvgPolyline> polylines_;
};

}  // namespace

void SvgNumbers::SkipSeparators() {
  const auto skip_space = [&] {
    while (!AtEnd() && IsSpace(Peek())) ++position_;
  };
  skip_space();
  if (AtEnd() || Peek() != ',' || !after_number_) return;
  ++position_;
  after_number_ = false;
  skip_space();
}

bool SvgNumbers::AtNumber() const {
  size_t at = position_;
  if (at < text_.size() && (text_[at] == '+' || text_[at] == '-')) ++at;
  if (at < text_.size() && text_[at] == '.') ++at;
  return at < text_.size() && IsDigit(text_[at]);
}

double SvgNumbers::Number() {
  if (!AtNumber()) Fail("a number");
  const char* const begin = text_.data() + position_ + (Peek() == '+' ? 1 : 0);
  double value = 0.0;
  const auto [end, error] = std::from_chars(begin, text_.data() + text_.size(), value);
  if (error != std::errc() || !std::isfinite(value)) Fail("a finite number");
  position_ = static_cast<size_t>(end - text_.data());
  after_number_ = true;
  return value;
}

bool SvgNumbers::Flag() {
  if (AtEnd() || (Peek() != '0' && Peek() != '1')) Fail("a flag, 0 or 1");
  after_number_ = true;
  return Take() == '1';
}

void SvgNumbers::Fail(std::string_view expected) const {
  const std::string found = AtEnd() ? "the end" : fmt::format("'{}'", text_.substr(position_, 12));
  throw Error(fmt::format("position {}: {}, expected {}", position_, found, expected));
}

SvgPath ParseSvgPath(std::string_view data, double tolerance) {
  DAUMIER_CHECK(tolerance > 0.0, "curves are to be flattened to {}, expected a positive tolerance", tolerance);
  return PathParser(data, tolerance).Parse();
}

}  // namespace daumier::render
