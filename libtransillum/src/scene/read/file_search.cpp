// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "scene/read/file_search.h"

#include <algorithm>
#include <iterator>
#include <vector>

#include "base/did_you_mean.h"
#include "base/text_file.h"

namespace transillum {
namespace {

constexpr std::size_t most_entries = 100'000;
/// Folders at the end of a path of another machine that are looked for.
constexpr std::ptrdiff_t most_parts = 8;

bool is_there(const std::filesystem::path& path) {
  std::error_code ignored;
  return std::filesystem::exists(path, ignored);
}

std::string with_slashes(std::string_view name) {
  std::string slashes(name);
  std::replace(slashes.begin(), slashes.end(), '\\', '/');
  return slashes;
}

}  // namespace

std::optional<std::filesystem::path> FileSearch::find(const std::filesystem::path& folder,
                                                      std::string_view name) {
  name = unquoted(trimmed(name));
  if (name.empty()) {
    return {};
  }
  if (is_there(folder / name)) {
    return folder / name;
  }
  // The end of a path of another machine may exist here: the file, or some of its folders too.
  const std::filesystem::path path = with_slashes(name);
  const auto parts = std::min<std::ptrdiff_t>(std::distance(path.begin(), path.end()), most_parts);
  for (const bool ignore_case : {false, true}) {
    for (std::ptrdiff_t used = parts; used > 0; --used) {
      std::filesystem::path end;
      for (auto part = std::prev(path.end(), used); part != path.end(); ++part) {
        end /= *part;
      }
      if (!ignore_case && is_there(folder / end)) {
        return folder / end;
      }
      if (auto found = ignore_case ? find_ignoring_case(folder, end) : std::nullopt) {
        return found;
      }
    }
  }
  return {};
}

std::optional<std::filesystem::path> FileSearch::find_ignoring_case(
    const std::filesystem::path& folder, const std::filesystem::path& name) {
  std::filesystem::path path = folder;
  for (const std::filesystem::path& part : name) {
    if (is_there(path / part)) {
      path /= part;
      continue;
    }
    const Entries& known = entries(path);
    const auto entry = known.find(lower_case(part.string()));
    if (entry == known.end()) {
      return {};
    }
    path /= entry->second;
  }
  return name.empty() ? std::nullopt : std::optional(path);
}

std::string FileSearch::similar(const std::filesystem::path& folder, std::string_view name) {
  const std::filesystem::path file =
      std::filesystem::path(with_slashes(unquoted(trimmed(name)))).filename();
  const std::string ending = lower_case(file.extension().string());
  std::vector<std::string> names;
  for (const auto& [lower, entry] : entries(folder)) {
    if (lower_case(std::filesystem::path(entry).extension().string()) == ending) {
      names.push_back(entry);
    }
  }
  return nearest_name(file.string(), names);
}

const FileSearch::Entries& FileSearch::entries(const std::filesystem::path& folder) {
  const auto [known, is_new] = folders_.try_emplace(folder);
  if (!is_new) {
    return known->second;
  }
  std::error_code error;
  std::filesystem::directory_iterator entry(folder.empty() ? "." : folder, error), end;
  for (std::size_t k = 0; !error && entry != end && k < most_entries; entry.increment(error), ++k) {
    const std::string name = entry->path().filename().string();
    std::string& kept = known->second[lower_case(name)];
    // Where names differ in case only, the same one in any order of the folder.
    kept = kept.empty() ? name : std::min(kept, name);
  }
  return known->second;
}

}  // namespace transillum
