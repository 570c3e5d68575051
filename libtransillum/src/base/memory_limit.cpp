// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// proc(5), cgroups(7), getrlimit(2).
#include "base/memory_limit.h"

#include <malloc.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <limits>
#include <optional>
#include <string>

namespace transillum {
namespace {

constexpr std::uint64_t unlimited = std::numeric_limits<std::uint64_t>::max();

std::uint64_t difference(std::uint64_t a, std::uint64_t b) { return a > b ? a - b : 0; }

/// The number in a file; nothing where there is none, as in "max".
std::optional<std::uint64_t> number_in(const std::string& path) {
  std::ifstream in(path);
  std::uint64_t value = 0;
  return in >> value ? std::optional(value) : std::nullopt;
}

std::uint64_t free_on_machine() {
  std::ifstream in("/proc/meminfo");
  std::uint64_t available = 0, kilobytes = 0;
  std::string name, unit;
  while (in >> name >> kilobytes) {
    if (name == "MemAvailable:" || name == "SwapFree:") {
      available += 1024 * kilobytes;
    }
    std::getline(in, unit);
  }
  return available > 0 ? available : unlimited;
}

std::uint64_t free_in_group() {
  std::ifstream in("/proc/self/cgroup");
  std::string line;
  std::getline(in, line);
  if (line.rfind("0::", 0) != 0) {
    return unlimited;
  }
  const std::string folder = "/sys/fs/cgroup" + line.substr(3);
  const auto most = number_in(folder + "/memory.max"), used = number_in(folder + "/memory.current");
  return most && used ? difference(*most, *used) : unlimited;
}

std::uint64_t free_addresses() {
  rlimit limit{};
  if (::getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) {
    return unlimited;
  }
  const auto pages = number_in("/proc/self/statm");
  return difference(limit.rlim_cur,
                    pages.value_or(0) * static_cast<std::uint64_t>(::sysconf(_SC_PAGE_SIZE)));
}

}  // namespace

std::uint64_t free_memory() {
  return std::min({free_on_machine(), free_in_group(), free_addresses()});
}

void return_freed_memory() { malloc_trim(0); }

}  // namespace transillum
