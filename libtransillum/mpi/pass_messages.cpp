// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// The messages in which one member of a group tells the others of a pass that it has made.
//
// Format, in the byte order and layout of the machine: Header; a Coverage for each patch owned by
// the receiver, or two; perhaps back_seen of each; the exchanges, in the order of the pass. With
// moments, coverages are followed by their moments, and each exchange is followed by its own. A
// patch faces omega or -omega, so mostly one Coverage says both: a negative projected area stands
// for the backward one.
#include "pass_messages.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <type_traits>
#include <utility>
#include <vector>

#include "transillum/at.h"

namespace transillum::mpi {
namespace {

constexpr std::size_t unit = 16;  ///< unit of message sizes, bytes

struct Header {
  Vec3 direction;
  ClosureDefect closure;
  PassCounts counts;
  double projected = 0, covered = 0;
  std::int64_t exchanges = 0;   ///< exchanges of the whole pass
  std::uint64_t sent = 0;       ///< exchanges in this message
  std::uint32_t two_sided = 0;  ///< forward and backward coverages, one list after the other
  std::uint32_t back_seen = 0;  ///< whether back_seen is there
  std::uint64_t moments = 0;    ///< whether moments are there
};
static_assert(std::is_trivially_copyable_v<Header> && std::is_trivially_copyable_v<Transfer> &&
              std::is_trivially_copyable_v<Coverage> &&
              std::is_trivially_copyable_v<TransferMoments> &&
              std::is_trivially_copyable_v<CoverageMoments>);

/// Appends values to a message whose memory is there.
class Writer {
 public:
  explicit Writer(std::byte* place) : place_(place) {}
  template <class T>
  void put(const T& value) {
    put_list(&value, 1);
  }
  template <class T>
  void put_list(const T* first, std::size_t count) {
    std::memcpy(place_, first, count * sizeof(T));
    place_ += count * sizeof(T);
  }

 private:
  std::byte* place_;
};

class Reader {
 public:
  explicit Reader(std::span<const std::byte> bytes) : bytes_(bytes) {}
  template <class T>
  T get() {
    T value;
    std::memcpy(&value, bytes_.data(), sizeof(T));
    bytes_ = bytes_.subspan(sizeof(T));
    return value;
  }
  template <class T>
  std::vector<T> list(std::size_t count) {
    // Lists begin at multiples of 8 bytes, as their values must.
    const T* first = reinterpret_cast<const T*>(bytes_.data());
    bytes_ = bytes_.subspan(count * sizeof(T));
    return {first, first + count};
  }

 private:
  std::span<const std::byte> bytes_;
};

bool is_empty(const Coverage& coverage) { return coverage.projected == 0 && coverage.covered == 0; }

/// The member that owns each patch.
std::vector<std::uint32_t> owners_of(const PatchSums& group, PatchId patches) {
  std::vector<std::uint32_t> owners(static_cast<std::size_t>(patches));
  for (int r = 0; r < group.size(); ++r) {
    const PatchRange range = group.range_of(r, patches);
    std::fill(owners.begin() + range.first, owners.begin() + range.last,
              static_cast<std::uint32_t>(r));
  }
  return owners;
}

/// Where the exchanges whose receivers each member owns begin; then the end of all. Exchanges are
/// sorted by receiver.
std::vector<std::size_t> slices_of(const std::vector<Transfer>& exchanges, const PatchSums& group,
                                   PatchId patches) {
  std::vector<std::size_t> slices{0};
  for (int r = 0; r < group.size(); ++r) {
    const auto end = std::partition_point(
        exchanges.begin(), exchanges.end(),
        [last = group.range_of(r, patches).last](const Transfer& t) { return t.receiver < last; });
    slices.push_back(static_cast<std::size_t>(end - exchanges.begin()));
  }
  return slices;
}

/// An exchange whose source is owned by another member than its receiver.
struct Crossing {
  std::size_t exchange;
  std::uint32_t owner;  ///< owner of the source
};

std::vector<Crossing> crossings_of(const std::vector<Transfer>& exchanges,
                                   const std::vector<std::size_t>& slices, const PatchSums& group,
                                   PatchId patches) {
  const std::vector<std::uint32_t> owners = owners_of(group, patches);
  std::vector<Crossing> crossings;
  crossings.reserve(exchanges.size() / 2);
  for (std::uint32_t r = 0; r + 1 < slices.size(); ++r) {
    for (std::size_t k = slices[r]; k < slices[r + 1]; ++k) {
      const std::uint32_t owner = at(owners, exchanges[k].source);
      if (owner != r) {
        crossings.push_back({k, owner});
      }
    }
  }
  return crossings;
}

/// The header of the message to one member, but for its exchanges.
Header header_for(const Pass& pass, const PatchRange& owned) {
  Header header;
  header.direction = pass.transfers.direction;
  header.closure = pass.closure;
  header.counts = pass.transfers.counts;
  header.projected = pass.projected;
  header.covered = pass.covered;
  header.exchanges = pass.exchanges;
  header.moments = pass.transfers.forward_moments.empty() ? 0 : 1;
  for (auto i = static_cast<std::size_t>(owned.first); i < static_cast<std::size_t>(owned.last);
       ++i) {
    const Coverage &forward = pass.transfers.forward[i], &backward = pass.transfers.backward[i];
    if ((!is_empty(forward) && !is_empty(backward)) || std::signbit(forward.projected) ||
        std::signbit(backward.projected)) {
      header.two_sided = 1;
    }
    if (pass.transfers.back_seen[i] != 0) {
      header.back_seen = 1;
    }
  }
  return header;
}

std::size_t size_of(const Header& header, std::size_t patches) {
  const std::size_t bytes = sizeof(Header) +
                            patches * (header.two_sided ? 2 : 1) * sizeof(Coverage) +
                            (header.back_seen ? patches * sizeof(double) : 0) +
                            static_cast<std::size_t>(header.sent) * sizeof(Transfer) +
                            static_cast<std::size_t>(header.moments) *
                                (2 * patches * sizeof(CoverageMoments) +
                                 static_cast<std::size_t>(header.sent) * sizeof(TransferMoments));
  return (bytes + unit - 1) / unit * unit;
}

void write_coverages(Writer& writer, const Header& header, const Transfers& transfers,
                     const PatchRange& owned) {
  const auto first = static_cast<std::size_t>(owned.first);
  const auto last = static_cast<std::size_t>(owned.last);
  if (header.two_sided) {
    for (const auto* list : {&transfers.forward, &transfers.backward}) {
      for (std::size_t i = first; i < last; ++i) {
        writer.put((*list)[i]);
      }
    }
  } else {
    for (std::size_t i = first; i < last; ++i) {
      const Coverage& backward = transfers.backward[i];
      writer.put(is_empty(backward) ? transfers.forward[i]
                                    : Coverage{-backward.projected, backward.covered});
    }
  }
  for (std::size_t i = first; header.back_seen && i < last; ++i) {
    writer.put(transfers.back_seen[i]);
  }
  for (const auto* list : {&transfers.forward_moments, &transfers.backward_moments}) {
    for (std::size_t i = first; header.moments && i < last; ++i) {
      writer.put((*list)[i]);
    }
  }
}

/// Exchanges `first` to `last` - 1, each followed by its moments where there are any.
void write_exchanges(Writer& writer, const Transfers& transfers, std::size_t first,
                     std::size_t last) {
  if (transfers.moments.empty()) {
    writer.put_list(transfers.exchanges.data() + first, last - first);
    return;
  }
  for (std::size_t k = first; k < last; ++k) {
    writer.put(transfers.exchanges[k]);
    writer.put(transfers.moments[k]);
  }
}

void read_coverages(Reader& reader, const Header& header, std::size_t patches,
                    Transfers& transfers) {
  transfers.forward = reader.list<Coverage>(patches);
  if (header.two_sided) {
    transfers.backward = reader.list<Coverage>(patches);
  } else {
    transfers.backward.resize(patches);
    for (std::size_t i = 0; i < patches; ++i) {
      Coverage& forward = transfers.forward[i];
      if (std::signbit(forward.projected)) {
        transfers.backward[i] = {-forward.projected, forward.covered};
        forward = {};
      }
    }
  }
  transfers.back_seen =
      header.back_seen ? reader.list<double>(patches) : std::vector<double>(patches);
  if (header.moments) {
    transfers.forward_moments = reader.list<CoverageMoments>(patches);
    transfers.backward_moments = reader.list<CoverageMoments>(patches);
  }
}

}  // namespace

GroupMessages split(const Pass& pass, const PatchSums& group, PatchId patches) {
  const auto members = static_cast<std::size_t>(group.size());
  const std::vector<Transfer>& exchanges = pass.transfers.exchanges;
  const std::vector<std::size_t> slices = slices_of(exchanges, group, patches);
  const std::vector<Crossing> crossings = crossings_of(exchanges, slices, group, patches);
  std::vector<Header> headers;
  for (std::size_t r = 0; r < members; ++r) {
    headers.push_back(header_for(pass, group.range_of(static_cast<int>(r), patches)));
    headers[r].sent = slices[r + 1] - slices[r];
  }
  for (const Crossing& crossing : crossings) {
    ++headers[crossing.owner].sent;
  }
  GroupMessages messages;
  messages.begin.push_back(0);
  for (std::size_t r = 0; r < members; ++r) {
    const std::size_t owned = group.range_of(static_cast<int>(r), patches).size();
    messages.begin.push_back(messages.begin.back() + size_of(headers[r], owned));
  }
  messages.bytes = std::make_unique_for_overwrite<std::byte[]>(messages.begin.back());
  std::vector<Writer> writers;
  for (std::size_t r = 0; r < members; ++r) {
    writers.emplace_back(messages.bytes.get() + messages.begin[r]);
    writers.back().put(headers[r]);
    write_coverages(writers.back(), headers[r], pass.transfers,
                    group.range_of(static_cast<int>(r), patches));
  }
  // In the order of the pass: from slice to slice, first to its member, then to the others.
  auto crossing = crossings.begin();
  for (std::size_t r = 0; r < members; ++r) {
    write_exchanges(writers[r], pass.transfers, slices[r], slices[r + 1]);
    for (; crossing != crossings.end() && crossing->exchange < slices[r + 1]; ++crossing) {
      write_exchanges(writers[crossing->owner], pass.transfers, crossing->exchange,
                      crossing->exchange + 1);
    }
  }
  return messages;
}

Pass joined_pass(std::span<const std::byte> message, const PatchRange& owned) {
  Reader reader(message);
  const auto header = reader.get<Header>();
  Pass pass;
  pass.closure = header.closure;
  pass.projected = header.projected;
  pass.covered = header.covered;
  pass.exchanges = header.exchanges;
  pass.transfers.direction = header.direction;
  pass.transfers.counts = header.counts;
  read_coverages(reader, header, owned.size(), pass.transfers);
  const auto sent = static_cast<std::size_t>(header.sent);
  if (header.moments) {
    for (std::size_t k = 0; k < sent; ++k) {
      pass.transfers.exchanges.push_back(reader.get<Transfer>());
      pass.transfers.moments.push_back(reader.get<TransferMoments>());
    }
  } else {
    pass.transfers.exchanges = reader.list<Transfer>(sent);
  }
  return pass;
}

/// One coverage per patch, and one or two exchanges per patch, each sent to at most two members.
std::uint64_t expected_message_bytes(PatchId patches) {
  return static_cast<std::uint64_t>(patches) * (sizeof(Coverage) + 3 * sizeof(Transfer));
}

}  // namespace transillum::mpi
