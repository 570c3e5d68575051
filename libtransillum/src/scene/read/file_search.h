// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>

namespace transillum {

/// Finds the files that a scene file names: as written, without quotes, with the separators of
/// Windows, as the end of a path of another machine, and without regard to case.
class FileSearch {
 public:
  /// The existing file or folder that `name` means for a file in `folder`.
  std::optional<std::filesystem::path> find(const std::filesystem::path& folder,
                                            std::string_view name);
  /// The name of a file in `folder` that is similar to `name` and has the same ending; empty if
  /// there is none.
  std::string similar(const std::filesystem::path& folder, std::string_view name);

 private:
  using Entries = std::map<std::string, std::string>;  ///< by name in lower case: the name
  std::optional<std::filesystem::path> find_ignoring_case(const std::filesystem::path& folder,
                                                          const std::filesystem::path& name);
  /// The entries of a folder, read once, at most 100,000.
  const Entries& entries(const std::filesystem::path& folder);

  std::map<std::filesystem::path, Entries> folders_;
};

}  // namespace transillum
