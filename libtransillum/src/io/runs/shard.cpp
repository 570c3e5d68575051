// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Shards: sealed files with the transfers of passes, one after the other. Of lists that are mostly
// 0, only the entries that are not are stored.
#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <map>
#include <mutex>
#include <ostream>
#include <sstream>
#include <tuple>
#include <utility>

#include "io/runs/run_identity.h"
#include "io/runs/sealed_file.h"
#include "io/runs/shard_files.h"
#include "radiosity/state_archive.h"
#include "transillum/at.h"
#include "transillum/errors.h"

namespace transillum {

namespace {

using Json = nlohmann::ordered_json;

constexpr const char* shard_kind = "shard";

/// The entries of a list whose bits are not all 0, and where they are.
struct SparseList {
  std::vector<std::uint64_t> used;  ///< bit i of the list: entry i is stored
  std::vector<double> values;

  explicit SparseList(std::size_t size = 0) : used((size + 63) / 64) {}

  void put(std::size_t i, double value) {
    if (std::bit_cast<std::uint64_t>(value) != 0) {
      used[i / 64] |= std::uint64_t{1} << (i % 64);
      values.push_back(value);
    }
  }
  /// Calls set(i, value) for each entry stored; returns whether all indices are below `size`.
  template <class Set>
  bool for_each(std::size_t size, Set set) const {
    std::size_t k = 0;
    for (std::size_t word = 0; word < used.size(); ++word) {
      for (std::uint64_t bits = used[word]; bits != 0; bits &= bits - 1) {
        const std::size_t i = 64 * word + static_cast<std::size_t>(std::countr_zero(bits));
        if (i >= size || k == values.size()) {
          return false;
        }
        set(i, values[k++]);
      }
    }
    return k == values.size();
  }
  template <class Archive, class Self>
  static void visit_state(Archive& archive, Self& self) {
    archive.fixed(self.used);
    archive(self.values);
  }
};

struct StoredPass {
  std::int32_t number = 0;
  Vec3 direction;
  std::vector<Transfer> exchanges;
  /// Five numbers per patch: projected and covered, forward and backward; back_seen.
  SparseList areas;
  PassCounts counts;
  // Empty without moments
  std::vector<TransferMoments> moments;
  std::vector<CoverageMoments> forward_moments, backward_moments;

  std::size_t patches;

  explicit StoredPass(std::size_t patch_count) : areas(5 * patch_count), patches(patch_count) {}

  template <class Archive, class Self>
  static void visit_state(Archive& archive, Self& self) {
    auto& c = self.counts;
    archive(self.number, self.direction, self.exchanges, self.areas, c.pairs, c.cuts, c.decisions,
            c.exact_decisions, c.exact_queries, c.pixels, c.missed, c.seconds_order, c.seconds_bins,
            c.seconds_clip, self.moments);
    archive.empty_or(self.patches, self.forward_moments, self.backward_moments);
    archive.require(self.moments.empty() || self.moments.size() == self.exchanges.size());
  }
};

StoredPass stored(int number, const Transfers& transfers) {
  const std::size_t patches = transfers.forward.size();
  StoredPass pass(patches);
  pass.number = number;
  pass.direction = transfers.direction;
  pass.exchanges = transfers.exchanges;
  pass.counts = transfers.counts;
  pass.moments = transfers.moments;
  pass.forward_moments = transfers.forward_moments;
  pass.backward_moments = transfers.backward_moments;
  for (std::size_t i = 0; i < patches; ++i) {
    const Coverage &forward = transfers.forward[i], &backward = transfers.backward[i];
    std::size_t entry = 5 * i;
    for (const double value : {forward.projected, forward.covered, backward.projected,
                               backward.covered, transfers.back_seen[i]}) {
      pass.areas.put(entry++, value);
    }
  }
  return pass;
}

Transfers transfers_of(StoredPass pass, std::size_t patches) {
  Transfers transfers;
  transfers.direction = pass.direction;
  transfers.exchanges = std::move(pass.exchanges);
  transfers.counts = pass.counts;
  transfers.moments = std::move(pass.moments);
  transfers.forward_moments = std::move(pass.forward_moments);
  transfers.backward_moments = std::move(pass.backward_moments);
  transfers.forward.resize(patches);
  transfers.backward.resize(patches);
  transfers.back_seen.resize(patches);
  const bool complete = pass.areas.for_each(5 * patches, [&](std::size_t entry, double value) {
    const std::size_t i = entry / 5;
    Coverage &forward = transfers.forward[i], &backward = transfers.backward[i];
    double* const members[] = {&forward.projected, &forward.covered, &backward.projected,
                               &backward.covered, &transfers.back_seen[i]};
    *members[entry % 5] = value;
  });
  const auto exists = [patches](PatchId patch) {
    return patch >= 0 && static_cast<std::size_t>(patch) < patches;
  };
  if (!complete ||
      !std::all_of(transfers.exchanges.begin(), transfers.exchanges.end(),
                   [&](const Transfer& t) { return exists(t.receiver) && exists(t.source); })) {
    throw DamagedState();
  }
  return transfers;
}

ShardInfo info_of(const SealedFile& file) {
  const Json& head = file.head();
  const Json share = head.value("share", Json()), run = head.value("run", Json());
  ShardInfo info;
  try {
    info.share = share_from_text(share.get<std::string>());
    info.passes = run.at("options").at("directions").get<int>();
    info.scene = run.at("scene").at("name").get<std::string>();
    info.notes = head.at("notes").get<std::vector<std::string>>();
  } catch (const Json::exception&) {
    file.refuse("its head is damaged");
  } catch (const InputError&) {
    file.refuse("its head is damaged");
  }
  if (info.share.of > info.passes) {
    file.refuse("its head is damaged");
  }
  return info;
}

/// Order of directions by their bits.
struct ByBits {
  static auto bits(const Vec3& v) {
    return std::tuple(std::bit_cast<std::uint64_t>(v.x), std::bit_cast<std::uint64_t>(v.y),
                      std::bit_cast<std::uint64_t>(v.z));
  }
  bool operator()(const Vec3& a, const Vec3& b) const { return bits(a) < bits(b); }
};

/// Shards that are read again and again.
class OpenShards {
 public:
  explicit OpenShards(std::size_t patches) : patches_(patches) {}

  void add(const std::string& name, const RunIdentity& identity, const Cancellation& cancellation) {
    auto file = std::make_unique<Shard>(SealedFile(name, shard_kind));
    check_identity(file->file, identity);
    const ShardInfo info = info_of(file->file);
    if (!shards_.empty() && info.share.of != count_) {
      file->file.refuse(fmt::format("it is share {}, but {} is one of {}", info.share.text(),
                                    shards_.begin()->second->file.path().string(), count_));
    }
    count_ = info.share.of;
    if (const auto twice = shards_.find(info.share.number); twice != shards_.end()) {
      file->file.refuse(fmt::format("it is share {}, as is {}", info.share.text(),
                                    twice->second->file.path().string()));
    }
    file->file.check(cancellation);
    index(*file, info, cancellation);
    shards_.emplace(info.share.number, std::move(file));
  }
  void check_complete() const {
    std::vector<std::string> missing;
    for (int k = 1; k <= count_; ++k) {
      if (!shards_.contains(k)) {
        missing.push_back(Share{k, count_}.text());
      }
    }
    if (!missing.empty()) {
      constexpr std::size_t most_named = 8;
      const std::size_t more = missing.size() - std::min(missing.size(), most_named);
      missing.resize(missing.size() - more);
      throw InputError(fmt::format("shards are missing: {}{}", fmt::join(missing, ", "),
                                   more > 0 ? fmt::format(" and {} more", more) : ""));
    }
  }
  Transfers read(const Vec3& omega) const {
    const auto found = places_.find(omega);
    if (found == places_.end()) {
      throw InputError("no shard has the pass along this direction");
    }
    const auto [shard, position, size] = found->second;
    const std::lock_guard lock(shard->mutex);
    shard->file.seek(position);
    StateInput archive(shard->file.in(), size);
    StoredPass pass(patches_);
    try {
      archive(pass);
      return transfers_of(std::move(pass), patches_);
    } catch (const DamagedState& error) {
      shard->file.refuse(error.what());
    }
  }

 private:
  struct Shard {
    explicit Shard(SealedFile sealed) : file(std::move(sealed)) {}
    SealedFile file;
    std::mutex mutex;  ///< guards the stream
  };
  struct Place {
    Shard* shard;
    std::uint64_t position, size;
  };

  /// Notes where each pass of a shard is.
  void index(Shard& shard, const ShardInfo& info, const Cancellation& cancellation) {
    constexpr std::uint64_t length_size = sizeof(std::uint64_t);
    std::uint64_t position = 0;
    const int expected = (info.passes - info.share.number) / info.share.of + 1;
    int count = 0;
    for (const std::uint64_t end = shard.file.size(); position < end; ++count) {
      cancellation.throw_if_canceled();
      shard.file.seek(position);
      StateInput archive(shard.file.in(), end - position);
      std::uint64_t size = 0;
      std::int32_t number = 0;
      Vec3 direction;
      try {
        archive(size, number, direction);
        archive.require(number == info.share.number - 1 + count * info.share.of &&
                        size <= end - position - length_size);
      } catch (const DamagedState& error) {
        shard.file.refuse(error.what());
      }
      places_[direction] = {&shard, position + length_size, size};
      position += length_size + size;
    }
    if (count != expected) {
      shard.file.refuse(fmt::format("it is unfinished: it has {} of {} passes", count, expected));
    }
  }

  std::size_t patches_;
  int count_ = 0;
  std::map<int, std::unique_ptr<Shard>> shards_;
  std::map<Vec3, Place, ByBits> places_;
};

}  // namespace

void write_shard(const std::filesystem::path& file, const std::shared_ptr<const Scene>& scene,
                 const SolveOptions& options, const std::shared_ptr<const BspTree>& tree,
                 const ShardOptions& shard, const Cancellation& cancellation) {
  check_can_be_shared(options, shard.share);
  const Json head = {{"run", run_identity(*scene, options).json},
                     {"share", shard.share.text()},
                     {"notes", shard.notes}};
  write_sealed(file, shard_kind, head, [&](std::ostream& out) {
    int done = 0;
    make_passes(
        scene, options, tree, shard.share,
        [&](int number, const Transfers& transfers) {
          std::ostringstream bytes;
          StateOutput pass(bytes), length(out);
          pass(stored(number, transfers));
          const std::string text = bytes.str();
          length(static_cast<std::uint64_t>(text.size()));
          out << text;
          if (!out) {
            throw std::ios::failure("writing failed");
          }
          if (shard.progress) {
            shard.progress(++done);
          }
        },
        cancellation);
  });
}

ShardInfo read_shard_info(const std::filesystem::path& file) {
  return info_of(SealedFile(file, shard_kind));
}

TransferEngine engine_of_shards(const std::vector<std::string>& files, const Scene& scene,
                                const SolveOptions& options, const Cancellation& cancellation) {
  if (files.empty()) {
    throw InputError("there are no shards");
  }
  const auto patches = static_cast<std::size_t>(scene.patch_count());
  auto shards = std::make_shared<OpenShards>(patches);
  const RunIdentity identity = run_identity(scene, options);
  for (const std::string& file : files) {
    shards->add(file, identity, cancellation);
  }
  shards->check_complete();
  return [shards = std::shared_ptr<const OpenShards>(std::move(shards))](
             const Vec3& omega, const Cancellation&) { return shards->read(omega); };
}

}  // namespace transillum
