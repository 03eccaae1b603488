#include "render/svg_css.h"

#include "core/error.h"
#include "render/svg_text.h"

#include <algorithm>
#include <tuple>

namespace daumier::render {
namespace {

/// Limits of a sheet that is damaged or made to take long.
constexpr int kMaxBlockDepth = 8;
constexpr size_t kMaxCompounds = 32, kMaxSelectors = 100000, kMaxSelectorLength = 4096;

/// Neither white space, nor any character that has a meaning of its own in selectors.
bool IsCssNameCharacter(char c) {
  return std::string_view(" \t\r\n\f.#[]():>+~,*|=\"'{};/!@$%^&").find(c) == std::string_view::npos;
}

/// The name at the beginning of `text`, escapes replaced by their characters; removed from `text`.
std::string TakeCssName(std::string_view& text) {
  std::string name;
  while (!text.empty()) {
    if (text[0] == '\\' && text.size() > 1) {
      text.remove_prefix(1);
      size_t digits = 0;
      uint32_t code = 0;
      while (digits < std::min<size_t>(6, text.size())) {
        const size_t value = std::string_view("0123456789abcdef").find(Lowered(text.substr(digits, 1)));
        if (value == std::string_view::npos) break;
        code = 16 * code + static_cast<uint32_t>(value);
        ++digits;
      }
      if (digits == 0) {
        name += text[0];
        text.remove_prefix(1);
        continue;
      }
      name += static_cast<char>(code < 128 ? code : '?');
      text.remove_prefix(digits);
      if (!text.empty() && kSvgSpace.find(text[0]) != std::string_view::npos) text.remove_prefix(1);
    } else if (IsCssNameCharacter(text[0])) {
      name += text[0];
      text.remove_prefix(1);
    } else {
      break;
    }
  }
  DAUMIER_CHECK(!name.empty(), "expected a name");
  return name;
}

/// Comments, and the marks of SGML comments around a sheet, become spaces.
std::string WithoutCssComments(std::string_view css) {
  std::string text;
  while (!css.empty()) {
    if (css.starts_with("/*")) {
      const size_t end = css.find("*/", 2);
      css.remove_prefix(end == std::string_view::npos ? css.size() : end + 2);
      text += ' ';
    } else if (css.starts_with("<!--") || css.starts_with("-->")) {
      css.remove_prefix(css[0] == '<' ? 4 : 3);
    } else {
      text += css[0];
      css.remove_prefix(1);
    }
  }
  return text;
}

/// Position of the '}' that closes the block opened at `open`; the end of the text if it is missing.
size_t CssBlockEnd(std::string_view text, size_t open) {
  int depth = 0;
  char quote = 0;
  for (size_t i = open; i < text.size(); ++i) {
    const char c = text[i];
    if (c == '\\') {
      ++i;
    } else if (quote != 0) {
      if (c == quote) quote = 0;
    } else if (c == '"' || c == '\'') {
      quote = c;
    } else if (c == '{') {
      ++depth;
    } else if (c == '}' && --depth == 0) {
      return i;
    }
  }
  return text.size();
}

/// Whether a list of media queries holds for a screen; those about features of the device hold for light colours only.
bool IsForScreens(std::string_view queries) {
  const std::string lowered = Lowered(queries);
  std::string_view rest = lowered;
  if (Trimmed(rest).empty()) return true;
  while (!rest.empty()) {
    const size_t comma = std::min(rest.find(','), rest.size());
    const std::string_view query = Trimmed(rest.substr(0, comma));
    rest.remove_prefix(std::min(comma + 1, rest.size()));
    if (query == "all" || query == "screen" || query == "only screen" || query == "only all") return true;
    if (query.find("prefers-color-scheme") != std::string_view::npos && query.find("light") != std::string_view::npos)
      return true;
  }
  return false;
}

bool HasWord(std::string_view words, std::string_view wanted) {
  bool found = false;
  ForEachWord(words, [&](std::string_view word) { found = found || word == wanted; });
  return found;
}

pugi::xml_node ParentElement(const pugi::xml_node& node) {
  const pugi::xml_node parent = node.parent();
  return parent.type() == pugi::node_element ? parent : pugi::xml_node();
}

pugi::xml_node PreviousElement(pugi::xml_node node) {
  do node = node.previous_sibling();
  while (node && node.type() != pugi::node_element);
  return node;
}

}  // namespace

size_t FindInCss(std::string_view text, std::string_view wanted) {
  int depth = 0;
  char quote = 0;
  for (size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (c == '\\') {
      ++i;
    } else if (quote != 0) {
      if (c == quote) quote = 0;
    } else if (depth == 0 && wanted.find(c) != std::string_view::npos) {
      return i;
    } else if (c == '"' || c == '\'') {
      quote = c;
    } else if (c == '(' || c == '[') {
      ++depth;
    } else if ((c == ')' || c == ']') && depth > 0) {
      --depth;
    }
  }
  return std::string_view::npos;
}

std::vector<CssDeclaration> ParseCssDeclarations(std::string_view text) {
  const std::string plain = text.find("/*") == std::string_view::npos ? std::string(text) : WithoutCssComments(text);
  std::string_view rest = plain;
  std::vector<CssDeclaration> declarations;
  while (!rest.empty()) {
    const size_t end = std::min(FindInCss(rest, ";"), rest.size());
    const std::string_view piece = Trimmed(rest.substr(0, end));
    rest.remove_prefix(std::min(end + 1, rest.size()));
    const size_t colon = piece.find(':');
    if (colon == std::string_view::npos) continue;
    const std::string_view name = Trimmed(piece.substr(0, colon));
    std::string_view value = Trimmed(piece.substr(colon + 1));
    bool important = false;
    if (const size_t mark = value.rfind('!');
        mark != std::string_view::npos && Lowered(Trimmed(value.substr(mark + 1))) == "important") {
      important = true;
      value = Trimmed(value.substr(0, mark));
    }
    if (name.empty() || value.empty()) continue;
    declarations.push_back({name.starts_with("--") ? std::string(name) : Lowered(name), std::string(value), important});
  }
  return declarations;
}

std::string_view LocalName(const pugi::xml_node& node) {
  const std::string_view name = node.name();
  const size_t colon = name.find(':');
  return colon == std::string_view::npos ? name : name.substr(colon + 1);
}

void CssStyleSheet::Add(std::string_view css) {
  const std::string plain = WithoutCssComments(css);
  AddRules(plain, 0);
}

void CssStyleSheet::AddRules(std::string_view css, int depth) {
  while (!(css = Trimmed(css)).empty()) {
    const bool is_at_rule = css[0] == '@';
    const size_t head = std::min(FindInCss(css, is_at_rule ? ";{" : "{"), css.size());
    if (head == css.size() || css[head] == ';') {
      if (!is_at_rule || Lowered(css.substr(0, 7)) == "@import")
        ignored_.emplace_back(Trimmed(css.substr(0, std::min<size_t>(head, 60))));
      css.remove_prefix(std::min(head + 1, css.size()));
      continue;
    }
    const size_t end = CssBlockEnd(css, head);
    const std::string_view block = css.substr(head + 1, end - head - 1), prelude = css.substr(0, head);
    if (!is_at_rule) {
      AddRule(prelude, block);
    } else if (depth < kMaxBlockDepth) {
      const std::string name = Lowered(prelude.substr(0, prelude.find_first_of(" \t\r\n\f(")));
      const bool applies =
          name == "@supports" || name == "@layer" || (name == "@media" && IsForScreens(prelude.substr(name.size())));
      if (applies) AddRules(block, depth + 1);
    }
    css.remove_prefix(std::min(end + 1, css.size()));
  }
}

void CssStyleSheet::AddRule(std::string_view selectors, std::string_view block) {
  std::vector<Selector> parsed;
  std::string_view rest = selectors;
  try {
    do {
      const size_t comma = std::min(FindInCss(rest, ","), rest.size());
      parsed.push_back(ParseSelector(Trimmed(rest.substr(0, comma))));
      rest.remove_prefix(std::min(comma + 1, rest.size()));
    } while (!rest.empty());
    DAUMIER_CHECK(selectors_.size() + parsed.size() <= kMaxSelectors, "more than {} selectors", kMaxSelectors);
  } catch (const Error&) {  // One selector that is not understood makes its list void.
    ignored_.emplace_back(Trimmed(selectors.substr(0, 60)));
    return;
  }
  for (Selector& selector : parsed) {
    if (selector.compounds.empty()) continue;
    const Compound& right = selector.compounds[0];
    const std::string key = !right.ids.empty()       ? "#" + right.ids[0]
                            : !right.classes.empty() ? "." + right.classes[0]
                            : !right.type.empty()    ? right.type
                                                     : "*";
    selector.rule = rules_.size();
    by_key_[key].push_back(selectors_.size());
    selectors_.push_back(std::move(selector));
  }
  rules_.push_back(ParseCssDeclarations(block));
}

/// A selector without compounds is one that matches nothing. @throws Error if it is not understood.
CssStyleSheet::Selector CssStyleSheet::ParseSelector(std::string_view text) {
  DAUMIER_CHECK(!text.empty() && text.size() <= kMaxSelectorLength, "expected a selector");
  Selector selector;
  bool matches_nothing = false;
  Compound compound;
  const auto finish = [&] {
    selector.specificity += 1000000 * std::ssize(compound.ids) +
                            1000 * (std::ssize(compound.classes) + std::ssize(compound.attributes) + compound.is_root) +
                            (compound.type.empty() ? 0 : 1);
    selector.compounds.insert(selector.compounds.begin(), std::move(compound));
    DAUMIER_CHECK(selector.compounds.size() <= kMaxCompounds, "more than {} compounds", kMaxCompounds);
    compound = {};
  };
  while (!text.empty()) {
    const char c = text[0];
    if (kSvgSpace.find(c) != std::string_view::npos || c == '>' || c == '+') {
      text = Trimmed(text);
      const char sign = text.empty() ? ' ' : text[0];
      DAUMIER_CHECK(sign != '~', "unknown combinator");
      if (sign == '>' || sign == '+') text = Trimmed(text.substr(1));
      DAUMIER_CHECK(!text.empty(), "a selector ends with a combinator");
      finish();
      compound.combinator = sign == '>'   ? Combinator::kChild
                            : sign == '+' ? Combinator::kNextSibling
                                          : Combinator::kDescendant;
    } else if (c == '*') {
      text.remove_prefix(1);
    } else if (c == '|') {  // After the prefix of a namespace.
      text.remove_prefix(1);
      compound.type.clear();
    } else if (c == '.' || c == '#') {
      text.remove_prefix(1);
      (c == '.' ? compound.classes : compound.ids).push_back(TakeCssName(text));
    } else if (c == '[') {
      const size_t close = text.find(']');
      DAUMIER_CHECK(close != std::string_view::npos, "expected ]");
      std::string_view inside = Trimmed(text.substr(1, close - 1));
      text.remove_prefix(close + 1);
      Attribute attribute{TakeCssName(inside), {}, 0};
      inside = Trimmed(inside);
      if (!inside.empty()) {
        const size_t equals = inside.find('=');
        DAUMIER_CHECK(equals <= 1, "expected an operator");
        attribute.operation = inside[0];
        std::string_view value = Trimmed(inside.substr(equals + 1));
        if (value.size() >= 2 && (value[0] == '"' || value[0] == '\''))
          value = value.substr(1, value.rfind(value[0]) - 1);
        attribute.value = value;
      }
      compound.attributes.push_back(std::move(attribute));
    } else if (c == ':') {
      text.remove_prefix(1);
      const bool is_element = text.starts_with(':');
      if (is_element) text.remove_prefix(1);
      const std::string name = Lowered(TakeCssName(text));
      constexpr std::string_view kStates[] = {"hover",         "focus",  "active", "visited", "link",    "focus-within",
                                              "focus-visible", "target", "before", "after",   "checked", "disabled"};
      if (is_element || std::find(std::begin(kStates), std::end(kStates), name) != std::end(kStates)) {
        matches_nothing = true;
      } else {
        DAUMIER_CHECK(name == "root", "unknown pseudo-class");
        compound.is_root = true;
      }
    } else {
      compound.type = TakeCssName(text);
    }
  }
  finish();
  if (matches_nothing) selector.compounds.clear();
  return selector;
}

bool CssStyleSheet::Compound::Matches(const pugi::xml_node& element) const {
  if (!type.empty() && LocalName(element) != type) return false;
  if (is_root && ParentElement(element)) return false;
  const std::string_view id = element.attribute("id").value(), words = element.attribute("class").value();
  for (const auto& wanted : ids)
    if (wanted != id) return false;
  for (const auto& wanted : classes)
    if (!HasWord(words, wanted)) return false;
  return std::all_of(attributes.begin(), attributes.end(), [&](const Attribute& wanted) {
    const auto attribute = element.attribute(wanted.name.c_str());
    const std::string_view found = attribute.value();
    if (!attribute) return false;
    switch (wanted.operation) {
      case 0:
        return true;
      case '~':
        return HasWord(found, wanted.value);
      case '|':
        return found == wanted.value || found.starts_with(wanted.value + "-");
      case '^':
        return !wanted.value.empty() && found.starts_with(wanted.value);
      case '$':
        return !wanted.value.empty() && found.ends_with(wanted.value);
      case '*':
        return !wanted.value.empty() && found.find(wanted.value) != std::string_view::npos;
      default:
        return found == wanted.value;
    }
  });
}

bool CssStyleSheet::Selector::Matches(const pugi::xml_node& element) const {
  if (!compounds[0].Matches(element)) return false;
  // All elements that the compounds so far can end at, the innermost first.
  std::vector<pugi::xml_node> ends{element};
  for (size_t k = 1; k < compounds.size() && !ends.empty(); ++k) {
    std::vector<pugi::xml_node> next;
    const auto add = [&](const pugi::xml_node& node) {
      if (node && compounds[k].Matches(node)) next.push_back(node);
    };
    switch (compounds[k - 1].combinator) {
      case Combinator::kChild:
        for (const auto& node : ends) add(ParentElement(node));
        break;
      case Combinator::kNextSibling:
        for (const auto& node : ends) add(PreviousElement(node));
        break;
      case Combinator::kDescendant:
        for (auto node = ParentElement(ends[0]); node; node = ParentElement(node)) add(node);
    }
    ends = std::move(next);
  }
  return !ends.empty();
}

/// The selectors whose rightmost compound has the type, a class or the id of an element, or none of these.
std::vector<size_t> CssStyleSheet::Candidates(const pugi::xml_node& element) const {
  std::vector<std::string> keys{"*", std::string(LocalName(element)),
                                fmt::format("#{}", element.attribute("id").value())};
  ForEachWord(element.attribute("class").value(),
              [&](std::string_view word) { keys.push_back(fmt::format(".{}", word)); });
  std::sort(keys.begin(), keys.end());
  keys.erase(std::unique(keys.begin(), keys.end()), keys.end());
  std::vector<size_t> candidates;
  for (const auto& key : keys) {
    const auto found = by_key_.find(key);
    if (found != by_key_.end()) candidates.insert(candidates.end(), found->second.begin(), found->second.end());
  }
  return candidates;
}

std::vector<const CssDeclaration*> CssStyleSheet::Match(const pugi::xml_node& element) const {
  std::vector<size_t> matching = Candidates(element);
  std::erase_if(matching, [&](size_t selector) { return !selectors_[selector].Matches(element); });
  std::sort(matching.begin(), matching.end(), [&](size_t a, size_t b) {
    return std::tuple(selectors_[a].specificity, a) < std::tuple(selectors_[b].specificity, b);
  });
  std::vector<const CssDeclaration*> declarations;
  for (const size_t selector : matching)
    for (const auto& declaration : rules_[selectors_[selector].rule]) declarations.push_back(&declaration);
  return declarations;
}

}  // namespace daumier::render
