#pragma once
#include <cstdint>
#include <map>
#include <pugixml.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace daumier::render {

struct CssDeclaration {
  std::string name;  ///< In small letters, except custom properties (--name).
  std::string value;
  bool important = false;
};

/// Position of the first of `wanted` outside quotes and parentheses; npos if there is none.
size_t FindInCss(std::string_view text, std::string_view wanted);

/// The declarations of a style attribute or of a rule's block, in their order; what is no declaration is skipped
/// [CSS Syntax 3].
std::vector<CssDeclaration> ParseCssDeclarations(std::string_view text);

/// A node's name without its prefix.
std::string_view LocalName(const pugi::xml_node& node);

/// Rules of style sheets [CSS Selectors 3]: type, *, .class, #id, [attribute] with all its operators, :root, the
/// combinators for descendants, children and next siblings, and lists; blocks of @media for screens, @supports and
/// @layer. Selectors for states (:hover ...), pseudo-elements and printers match nothing.
class CssStyleSheet {
 public:
  /// Appends the rules of a sheet; bytes of any kind are survived.
  void Add(std::string_view css);

  /// The declarations of the rules that match an element: by specificity, then by order, the strongest last. Importance
  /// does not count here. Valid until the next Add.
  std::vector<const CssDeclaration*> Match(const pugi::xml_node& element) const;

  /// How many selectors Match compares with an element.
  size_t NumCandidates(const pugi::xml_node& element) const { return Candidates(element).size(); }

  /// Selectors and at-rules that are not understood; their rules are left out.
  const std::vector<std::string>& ignored() const { return ignored_; }

 private:
  enum class Combinator { kDescendant, kChild, kNextSibling };
  struct Attribute {
    std::string name, value;
    char operation;  ///< The character before '='; '=' if it has none, and 0 if the attribute only has to be there.
  };
  /// What one element has to be.
  struct Compound {
    std::string type;  ///< Empty: any.
    std::vector<std::string> classes, ids;
    std::vector<Attribute> attributes;
    bool is_root = false;
    Combinator combinator = Combinator::kDescendant;  ///< Between this compound and the one to its left.

    bool Matches(const pugi::xml_node& element) const;
  };
  struct Selector {
    std::vector<Compound> compounds;  ///< From right to left.
    int64_t specificity = 0;
    size_t rule = 0;

    bool Matches(const pugi::xml_node& element) const;
  };

  std::vector<size_t> Candidates(const pugi::xml_node& element) const;
  void AddRules(std::string_view css, int depth);
  void AddRule(std::string_view selectors, std::string_view block);
  static Selector ParseSelector(std::string_view text);

  std::vector<std::vector<CssDeclaration>> rules_;
  std::vector<Selector> selectors_;
  std::map<std::string, std::vector<size_t>, std::less<>>
      by_key_;  ///< Of the rightmost compound: "#id", ".class", type or "*".
  std::vector<std::string> ignored_;
};

}  // namespace daumier::render
