#include "render/svg_scene.h"

#include "core/error.h"
#include "render/svg_elements.h"
#include "render/svg_paint.h"
#include "render/svg_shapes.h"
#include "render/svg_text.h"
#include "render/svg_transform.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace daumier::render {
namespace {

using Eigen::Affine2d;
using Eigen::AlignedBox2d;
using Eigen::Vector2d;

/// What one element, and one selector that may match it, cost in units of SvgWork.
constexpr int64_t kWorkOfElement = 20000, kWorkOfSelector = 50;
/// Of all shapes together; memory is what they cost.
constexpr int64_t kMaxPoints = 10'000'000;
/// Clip paths that are clipped themselves.
constexpr int kMaxClipDepth = 8;

/// What an element hands to its children.
struct SceneContext {
  Affine2d sheet_from_local = Affine2d::Identity();
  SvgStyle style;
  double opacity = 1.0;
  int kind = 0;
  SvgUnits units;
  std::vector<std::shared_ptr<const SvgClip>> clips;
};

/// The sides that <use> sets of the <symbol> or <svg> that it shows.
struct UsedSize {
  std::string width, height;
};

std::optional<double> SizeOfRoot(const std::string& text, SvgAxis axis, const SvgUnits& units) {
  if (text.empty() || text == "auto" || text.ends_with('%') || Lowered(text).ends_with("vw") ||
      Lowered(text).ends_with("vh")) {
    return std::nullopt;
  }
  const double size = ParseSvgLength(text, axis, units);
  DAUMIER_CHECK(size > 0, "width and height must be positive");
  return size;
}

class SceneReader {
 public:
  SceneReader(const SvgDocument& document, const std::vector<std::string>& kind_names, double tolerance)
      : document_(document), kind_names_(kind_names), tolerance_(tolerance), work_(document.name()) {}

  SvgScene Read() {
    const pugi::xml_node root = document_.root();
    for (const auto& ignored : document_.sheet().ignored())
      scene_.problems.push_back(
          fmt::format("{}: the style sheet's '{}' is not understood", document_.Where(root), ignored));
    scene_.file = document_.name();
    SceneContext context;
    try {
      context = EnterRoot(root);
    } catch (const Error& error) {
      throw Error(fmt::format("{}: {}", document_.Where(root), error.what()));
    }
    if (context.style.IsDisplayed() && context.opacity > 0.0) VisitChildren(root, context, 1);
    return std::move(scene_);
  }

 private:
  void Report(const pugi::xml_node& node, const std::string& message) {
    // A document repeats its problems: one line for each kind of element is enough.
    if (reported_.insert(fmt::format("{} {}", node.name(), message)).second)
      scene_.problems.push_back(fmt::format("{}: {}", document_.Where(node), message));
  }

  SvgStyle StyleOf(const pugi::xml_node& node, const SvgStyle& parent) {
    work_.Spend(kWorkOfSelector * static_cast<int64_t>(document_.sheet().NumCandidates(node)));
    return SvgCascade(document_.sheet(), [&](const std::string& message) { Report(node, message); })
        .Compute(node, parent);
  }

  SceneContext EnterRoot(const pugi::xml_node& root) {
    SceneContext context;
    context.style = StyleOf(root, SvgStyle());
    context.units.font_size = context.style.font_size();
    const auto width = SizeOfRoot(context.style.Get(SvgProperty::kWidth), SvgAxis::kX, context.units),
               height = SizeOfRoot(context.style.Get(SvgProperty::kHeight), SvgAxis::kY, context.units);
    const auto view_box = ParseSvgViewBox(root.attribute("viewBox").value());
    scene_.width = width.value_or(0.0);
    scene_.height = height.value_or(0.0);
    if (view_box) {
      // A missing side follows from the other and the shape of the box.
      const Vector2d box = view_box->sizes();
      scene_.width = width ? *width : height ? *height * box.x() / box.y() : box.x();
      scene_.height = height ? *height : scene_.width * box.y() / box.x();
    }
    const Vector2d size(scene_.width, scene_.height);
    if (size.minCoeff() > 0.0) context.units.viewport = context.units.sheet = size;
    Enter(root, context);
    if (view_box) {
      context.sheet_from_local =
          context.sheet_from_local *
          PlaceSvgViewBox(*view_box, AlignedBox2d(Vector2d(0, 0), size), root.attribute("preserveAspectRatio").value());
      context.units.viewport = view_box->sizes();
    }
    scene_.background = ParseSvgColor(context.style.Get(SvgProperty::kBackgroundColor));
    return context;
  }

  /// What holds inside an element whose style is computed: transform, opacity, kind, clip.
  void Enter(const pugi::xml_node& node, SceneContext& context) {
    context.units.font_size = context.style.font_size();
    context.opacity *= context.style.Share(SvgProperty::kOpacity);
    context.kind = KindOf(node.attribute("class").value()).value_or(context.kind);
    Affine2d transform = ParseSvgTransform(context.style.Get(SvgProperty::kTransform));
    if (const auto& origin = context.style.Get(SvgProperty::kTransformOrigin); !origin.empty()) {
      const Vector2d point = OriginOf(origin, context.units);
      transform = Eigen::Translation2d(point) * transform * Eigen::Translation2d(-point);
    }
    context.sheet_from_local = context.sheet_from_local * transform;
    if (const auto& clip = context.style.Get(SvgProperty::kClipPath); clip != "none") AddClip(node, clip, context);
    for (const SvgProperty property : {SvgProperty::kMask, SvgProperty::kFilter}) {
      const std::string_view name = property == SvgProperty::kMask ? "mask" : "filter";
      if (context.style.Get(property) != "none") Report(node, fmt::format("its {} is not applied", name));
    }
  }

  static Vector2d OriginOf(std::string_view text, const SvgUnits& units) {
    std::vector<double> values;
    ForEachWord(text, [&](std::string_view word) {
      const SvgAxis axis = values.empty() ? SvgAxis::kX : SvgAxis::kY;
      const std::string length = word == "left" || word == "top"       ? "0"
                                 : word == "center"                    ? "50%"
                                 : word == "right" || word == "bottom" ? "100%"
                                                                       : std::string(word);
      values.push_back(ParseSvgLength(length, axis, units));
    });
    if (values.size() == 1) values.push_back(ParseSvgLength("50%", SvgAxis::kY, units));
    return {values.at(0), values.at(1)};
  }

  void VisitChildren(const pugi::xml_node& node, const SceneContext& context, int depth) {
    for (const auto& child : node.children())
      if (child.type() == pugi::node_element) Visit(child, context, depth, {});
  }

  void Visit(const pugi::xml_node& node, const SceneContext& outer, int depth, const std::optional<UsedSize>& used) {
    const std::string_view name = document_.SvgName(node);
    const SvgElement element = SvgElementOf(name);
    if (name.empty() || element == SvgElement::kUnpainted || (element == SvgElement::kSymbol && !used)) return;
    work_.Spend(kWorkOfElement);
    DAUMIER_CHECK(depth < kMaxSvgDepth, "{}: elements are nested more than {} deep", document_.Where(node),
                  kMaxSvgDepth);
    DAUMIER_CHECK(num_points_ <= kMaxPoints, "{}: the drawing has more than {} points", document_.name(), kMaxPoints);
    SceneContext context = outer;
    try {
      context.style = StyleOf(node, outer.style);
      if (!context.style.IsDisplayed() || context.style.Share(SvgProperty::kOpacity) == 0.0) return;
      if (element == SvgElement::kNoStrokes) {
        const bool is_empty = name == "text" && !node.first_child();
        if (!is_empty && context.style.IsVisible())
          Report(node, name == "image" ? "it is left out: it is a picture. Export the picture itself as PNG"
                                       : "it is left out: it has no strokes");
        return;
      }
      Enter(node, context);
      if (element == SvgElement::kShape) return AddShape(node, context);
      const bool is_viewport = element == SvgElement::kViewport || element == SvgElement::kSymbol;
      if (is_viewport && !EnterViewport(node, used.value_or(UsedSize{}), context)) return;
    } catch (const Error& error) {
      return Report(node, fmt::format("it is left out: {}", error.what()));
    }
    if (element == SvgElement::kUse) return VisitUsed(node, context, depth);
    if (element == SvgElement::kSwitch) return VisitSwitch(node, context, depth);
    if (element == SvgElement::kUnknown) return Report(node, "it is left out: no element of this name is drawn");
    VisitChildren(node, context, depth + 1);
  }

  /// Only the first child whose conditions hold is drawn.
  void VisitSwitch(const pugi::xml_node& node, const SceneContext& context, int depth) {
    for (const auto& child : node.children()) {
      if (child.type() != pugi::node_element || document_.SvgName(child).empty()) continue;
      const auto extensions = child.attribute("requiredExtensions"), language = child.attribute("systemLanguage");
      if (extensions && *extensions.value() != 0) continue;
      if (language && Lowered(language.value()).find("en") == std::string::npos) continue;
      return Visit(child, context, depth + 1, {});
    }
  }

  void VisitUsed(const pugi::xml_node& node, SceneContext context, int depth) {
    const pugi::xml_node target = document_.Referenced(node);
    if (!target) return Report(node, fmt::format("it is left out: '{}' is no element of the file", HrefOf(node)));
    DAUMIER_CHECK(std::find(used_.begin(), used_.end(), target) == used_.end(), "{}: it contains itself by '{}'",
                  document_.Where(node), HrefOf(node));
    UsedSize size;
    try {
      const auto length = [&](SvgProperty property, SvgAxis axis) {
        const std::string& text = context.style.Get(property);
        return text.empty() || text == "auto" ? 0.0 : ParseSvgLength(text, axis, context.units);
      };
      context.sheet_from_local.translate(
          Vector2d(length(SvgProperty::kX, SvgAxis::kX), length(SvgProperty::kY, SvgAxis::kY)));
      size = {context.style.Get(SvgProperty::kWidth), context.style.Get(SvgProperty::kHeight)};
    } catch (const Error& error) {
      return Report(node, fmt::format("it is left out: {}", error.what()));
    }
    used_.push_back(target);
    Visit(target, context, depth + 1, size);
    used_.pop_back();
  }

  /// Places the content of a nested <svg> or a <symbol>, whose own transform context holds. False if it has no area.
  bool EnterViewport(const pugi::xml_node& node, const UsedSize& used, SceneContext& context) {
    const auto length = [&](const std::string& text, SvgAxis axis) -> std::optional<double> {
      if (!text.empty() && text != "auto") return ParseSvgLength(text, axis, context.units);
      if (!context.units.viewport) return std::nullopt;
      return ParseSvgLength("100%", axis, context.units);
    };
    const auto side = [&](const std::string& of_use, SvgProperty property, SvgAxis axis) {
      return length(of_use.empty() ? context.style.Get(property) : of_use, axis);
    };
    const auto place = [&](SvgProperty property, SvgAxis axis) {
      const std::string& text = context.style.Get(property);
      return text.empty() ? 0.0 : ParseSvgLength(text, axis, context.units);
    };
    const auto view_box = ParseSvgViewBox(node.attribute("viewBox").value());
    auto width = side(used.width, SvgProperty::kWidth, SvgAxis::kX),
         height = side(used.height, SvgProperty::kHeight, SvgAxis::kY);
    if (view_box && !width) width = view_box->sizes().x();
    if (view_box && !height) height = view_box->sizes().y();
    const Vector2d corner(place(SvgProperty::kX, SvgAxis::kX), place(SvgProperty::kY, SvgAxis::kY));
    if (!width || !height) {
      context.sheet_from_local.translate(corner);
      return true;
    }
    if (*width <= 0.0 || *height <= 0.0) return false;
    const AlignedBox2d viewport(corner, corner + Vector2d(*width, *height));
    const auto& overflow = context.style.Get(SvgProperty::kOverflow);
    if (overflow != "visible" && overflow != "auto") {
      SvgPolyline ring;
      for (const auto corner_type : {AlignedBox2d::BottomLeft, AlignedBox2d::BottomRight, AlignedBox2d::TopRight,
                                     AlignedBox2d::TopLeft, AlignedBox2d::BottomLeft}) {
        ring.points.emplace_back(context.sheet_from_local * viewport.corner(corner_type));
      }
      context.clips.push_back(std::make_shared<SvgClip>(std::vector<SvgArea>{{{std::move(ring)}}}));
    }
    if (view_box) {
      context.sheet_from_local = context.sheet_from_local *
                                 PlaceSvgViewBox(*view_box, viewport, node.attribute("preserveAspectRatio").value());
      context.units.viewport = view_box->sizes();
    } else {
      context.sheet_from_local.translate(corner);
      context.units.viewport = viewport.sizes();
    }
    return true;
  }

  std::optional<int> KindOf(std::string_view words) const {
    std::optional<int> kind;
    ForEachWord(words, [&](std::string_view word) {
      const auto found = std::find(kind_names_.begin(), kind_names_.end(), word);
      if (!kind && found != kind_names_.end()) kind = static_cast<int>(found - kind_names_.begin());
    });
    return kind;
  }

  /// The polylines of a shape on the sheet. @throws Error if a point is not finite.
  std::vector<SvgPolyline> PolylinesOf(const pugi::xml_node& node, const std::string& data, const Affine2d& transform) {
    const double scale = 2.0 * transform.linear().cwiseAbs().maxCoeff();  // Of the linear part no vector grows more.
    const double side = std::max({scene_.width, scene_.height, 1.0});
    SvgPath path = ParseSvgPath(data, tolerance_ * side / std::max(scale, 1e-12));
    for (SvgPolyline& polyline : path.polylines) {
      num_points_ += std::ssize(polyline.points);
      for (Vector2d& point : polyline.points) {
        const Vector2d local = point;
        point = transform * local;
        DAUMIER_CHECK(point.cast<float>().allFinite(), "a point lies at ({}, {})", point.x(), point.y());
      }
    }
    if (path.error) {
      Report(node, fmt::format("{}; it is drawn up to there", *path.error));
      if (document_.SvgName(node) == "polygon" && !path.polylines.empty())
        path.polylines[0].points.push_back(path.polylines[0].points.front());
    }
    return std::move(path.polylines);
  }

  void AddShape(const pugi::xml_node& node, const SceneContext& context) {
    const SvgStyle& style = context.style;
    if (!style.IsVisible()) return;
    const auto report = [&](const std::string& message) { Report(node, message); };
    SvgShape shape{.polylines = PolylinesOf(node, *SvgShapeData(node, style, context.units), context.sheet_from_local),
                   .fill = SvgPaint(document_, style, SvgProperty::kFill, report),
                   .stroke = SvgPaint(document_, style, SvgProperty::kStroke, report),
                   .is_fill_given = style.IsGiven(SvgProperty::kFill),
                   .is_stroke_given = style.IsGiven(SvgProperty::kStroke),
                   .fill_rule = RuleOf(style, SvgProperty::kFillRule),
                   .kind = context.kind,
                   .clips = context.clips};
    if (const std::string_view original = node.attribute("inkscape:original-d").value(); !original.empty())
      for (SvgPolyline& line : PolylinesOf(node, std::string(original), context.sheet_from_local))
        shape.drawn_lines.push_back(std::move(line.points));
    for (const SvgProperty marker : {SvgProperty::kMarkerStart, SvgProperty::kMarkerMid, SvgProperty::kMarkerEnd})
      if (style.Get(marker) != "none") Report(node, "its markers are not drawn");
    if (shape.stroke) {
      const auto& width = style.Get(SvgProperty::kStrokeWidth);
      const bool is_scaled = style.Get(SvgProperty::kVectorEffect).find("non-scaling-stroke") == std::string::npos;
      const double scale = is_scaled ? std::sqrt(std::abs(context.sheet_from_local.linear().determinant())) : 1.0;
      shape.stroke_width = scale * ParseSvgLength(width, SvgAxis::kDiagonal, context.units);
      if (ParseSvgLength(width, SvgAxis::kDiagonal, context.units) == 0.0) shape.stroke.reset();
    }
    for (auto* paint : {&shape.fill, &shape.stroke}) {
      if (*paint) (*paint)->alpha *= context.opacity;
      if (*paint && (*paint)->alpha <= 0.0) paint->reset();
    }
    if ((shape.fill || shape.stroke) && !shape.polylines.empty()) scene_.shapes.push_back(std::move(shape));
  }

  static FillRule RuleOf(const SvgStyle& style, SvgProperty property) {
    return style.Get(property) == "evenodd" ? FillRule::kEvenOdd : FillRule::kNonzero;
  }

  void AddClip(const pugi::xml_node& node, const std::string& value, SceneContext& context, int depth = 0) {
    const auto id = SvgReference(value);
    const pugi::xml_node clip_path = id ? document_.ById(*id) : pugi::xml_node();
    if (!clip_path || document_.SvgName(clip_path) != "clipPath" || depth >= kMaxClipDepth)
      return Report(node, fmt::format("clip-path '{}' is not applied", value.substr(0, 60)));
    const SvgStyle style = StyleOf(clip_path, SvgStyle());
    if (const auto& own = style.Get(SvgProperty::kClipPath); own != "none") AddClip(clip_path, own, context, depth + 1);
    SceneContext inner = context;
    inner.style = style;
    if (std::string_view(clip_path.attribute("clipPathUnits").value()) == "objectBoundingBox") {
      const AlignedBox2d box = BoxOfShape(node, context);
      if (box.isEmpty()) return Report(node, "its clip path is not applied: it refers to the box of a group");
      inner.sheet_from_local.translate(box.min()).scale(box.sizes());
    }
    inner.sheet_from_local = inner.sheet_from_local * ParseSvgTransform(style.Get(SvgProperty::kTransform));
    std::vector<SvgArea> areas;
    for (const auto& child : clip_path.children())
      if (child.type() == pugi::node_element) AddClipArea(child, inner, areas);
    context.clips.push_back(std::make_shared<SvgClip>(std::move(areas)));
  }

  void AddClipArea(const pugi::xml_node& node, SceneContext context, std::vector<SvgArea>& areas) {
    work_.Spend(kWorkOfElement);
    const std::string_view name = document_.SvgName(node);
    if (name.empty() || SvgElementOf(name) == SvgElement::kUnpainted) return;
    context.style = StyleOf(node, context.style);
    if (!context.style.IsDisplayed() || !context.style.IsVisible()) return;
    context.sheet_from_local = context.sheet_from_local * ParseSvgTransform(context.style.Get(SvgProperty::kTransform));
    if (name == "use") {
      const pugi::xml_node target = document_.Referenced(node);
      const auto at = [&](SvgProperty property, SvgAxis axis) {
        const std::string& text = context.style.Get(property);
        return text.empty() ? 0.0 : ParseSvgLength(text, axis, context.units);
      };
      context.sheet_from_local.translate(Vector2d(at(SvgProperty::kX, SvgAxis::kX), at(SvgProperty::kY, SvgAxis::kY)));
      // A clip path may use shapes only.
      if (target && document_.SvgName(target) != "use") AddClipArea(target, context, areas);
    } else if (const auto data = SvgShapeData(node, context.style, context.units)) {
      areas.push_back(
          {PolylinesOf(node, *data, context.sheet_from_local), RuleOf(context.style, SvgProperty::kClipRule)});
      for (const auto& ring : areas.back().rings) work_.Spend(100 * std::ssize(ring.points));
    } else {
      Report(node, "it is left out of a clip path");
    }
  }

  /// The box of a shape in its own coordinates; empty for other elements.
  AlignedBox2d BoxOfShape(const pugi::xml_node& node, const SceneContext& context) {
    AlignedBox2d box;
    if (const auto data = SvgShapeData(node, context.style, context.units)) {
      for (const auto& polyline : PolylinesOf(node, *data, Affine2d::Identity()))
        for (const auto& point : polyline.points) box.extend(point);
    }
    return box;
  }

  const SvgDocument& document_;
  const std::vector<std::string>& kind_names_;
  double tolerance_;
  SvgScene scene_;
  SvgWork work_;
  int64_t num_points_ = 0;
  std::set<std::string> reported_;
  std::vector<pugi::xml_node> used_;  ///< What the <use> elements around the current one refer to.
};

}  // namespace

SvgScene ReadSvgScene(const SvgDocument& document, const std::vector<std::string>& kind_names, double tolerance) {
  return SceneReader(document, kind_names, tolerance).Read();
}

}  // namespace daumier::render
