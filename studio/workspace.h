#pragma once
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace daumier::studio {

/// The folder in which a studio keeps things of one kind, a sub-folder each, named by prefix and number: s-0001. A removed
/// name is not given away again while the program runs. Not thread-safe.
class NumberedFolders {
 public:
  /// Makes the folder where it is missing. @throws Error as MakeDirectory.
  NumberedFolders(std::filesystem::path folder, char prefix);

  /// Makes the next folder and returns its name.
  std::string Add();
  /// The folder of a name. @throws NotFound if there is none, or the name has another form, so that no name leaves the folder.
  std::filesystem::path Of(std::string_view name) const;
  bool Has(std::string_view name) const;
  /// Removes the folder and all in it. @throws NotFound as Of; Error naming the cause.
  void Remove(std::string_view name);
  /// Ascending.
  std::vector<std::string> Names() const;

 private:
  bool IsName(std::string_view name) const;

  std::filesystem::path folder_;
  char prefix_;
  int last_ = 0;  ///< The greatest number that was given away.
};

/// A name that a person typed, as it is kept: without control characters of ASCII and Latin 1, at most 80 characters, cut between them.
/// `otherwise` where nothing is left.
std::string KeptName(std::string_view name, std::string_view otherwise);

}  // namespace daumier::studio
