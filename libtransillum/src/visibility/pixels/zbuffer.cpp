// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// The generalized z-buffer: for each pixel a list of all patches over its center, sorted by height.
// All lists together would take memory proportional to resolution² times depth. So rows are
// processed in bands, for which all spans of the outlines are kept, and lists are made for a few
// columns of one row at a time.
#include "visibility/pixels/zbuffer.h"

#include <algorithm>
#include <numeric>
#include <vector>

#include "transillum/at.h"
#include "visibility/pixels/outlines.h"

namespace transillum {
namespace {

/// @tparam Outlines PieceOutlines or SnappedFragments
template <class Outlines>
class ZBuffer {
 public:
  ZBuffer(const Outlines& outlines, std::span<const std::int32_t> numbers, const PixelGrid& grid,
          const PatchHeights& heights, VisibilitySink& sink, const Cancellation& cancellation)
      : outlines_(outlines),
        numbers_(numbers),
        grid_(grid),
        heights_(heights),
        sink_(sink),
        cancellation_(cancellation),
        converter_(grid),
        depth_(static_cast<std::size_t>(grid.columns()) + 1) {}

  void fill() {
    const std::vector<std::int64_t> spans = spans_by_row();
    for (int begin = 0; begin < grid_.rows();) {
      std::int64_t count = at(spans, begin);
      int end = begin + 1;
      while (end < grid_.rows() && count + at(spans, end) <= max_spans) {
        count += at(spans, end++);
      }
      fill_band(begin, end);
      begin = end;
    }
  }

 private:
  using Sample = PatchHeights::HeightSample;
  /// The pixels of a row that an outline covers.
  struct Span {
    int row, begin, end;
    PatchId patch;
  };
  struct Rows {
    int begin, end;
  };
  static constexpr std::int64_t max_spans = 1 << 18;  ///< per band; more if one row has more
  static constexpr std::int64_t max_samples = 1
                                              << 18;  ///< per part of a row; more if one pixel has

  Rows rows_of(std::int32_t number) const {
    std::int64_t low = INT64_MAX, high = INT64_MIN;
    outlines_.for_each_corner(number, [&](const PixelPoint& corner) {
      low = std::min(low, corner.y);
      high = std::max(high, corner.y);
    });
    return {std::max(grid_.first_center_from(low), 0),
            std::min(grid_.first_center_from(high), grid_.rows())};
  }

  /// Number of outlines that reach each row.
  std::vector<std::int64_t> spans_by_row() const {
    std::vector<std::int64_t> count(static_cast<std::size_t>(grid_.rows()) + 1, 0);
    std::size_t done = 0;
    for (const std::int32_t number : numbers_) {
      if (done++ % 1024 == 0) {
        cancellation_.throw_if_canceled();
      }
      const Rows rows = rows_of(number);
      if (heights_.edge_on(outlines_.patch(number)) || rows.begin >= rows.end) {
        continue;
      }
      ++at(count, rows.begin);
      --at(count, rows.end);
    }
    for (std::size_t row = 1; row < count.size(); ++row) {
      count[row] += count[row - 1];
    }
    return count;
  }

  void fill_band(int begin, int end) {
    spans_.clear();
    std::size_t done = 0;
    for (const std::int32_t number : numbers_) {
      if (done++ % 16 == 0) {
        cancellation_.throw_if_canceled();
      }
      convert(number, begin, end);
    }
    std::stable_sort(spans_.begin(), spans_.end(),
                     [](const Span& a, const Span& b) { return a.row < b.row; });
    for (std::size_t first = 0; first < spans_.size();) {
      std::size_t last = first;
      while (last < spans_.size() && spans_[last].row == spans_[first].row) {
        ++last;
      }
      fill_row(spans_.data() + first, spans_.data() + last);
      first = last;
    }
  }

  void convert(std::int32_t number, int begin, int end) {
    const PatchId patch = outlines_.patch(number);
    if (heights_.edge_on(patch)) {
      return;
    }
    converter_.begin(begin, end);
    outlines_.add_edges(number, converter_);
    converter_.finish([&](int row, int first, int last) {
      spans_.push_back({row, first, last, patch});
    });
  }

  void fill_row(const Span* first, const Span* last) {
    std::fill(depth_.begin(), depth_.end(), 0);
    for (const Span* span = first; span < last; ++span) {
      ++at(depth_, span->begin);
      --at(depth_, span->end);
    }
    for (std::size_t k = 1; k < depth_.size(); ++k) {
      depth_[k] += depth_[k - 1];
    }
    for (int begin = 0; begin < grid_.columns();) {
      std::int64_t count = at(depth_, begin);
      int end = begin + 1;
      while (end < grid_.columns() && count + at(depth_, end) <= max_samples) {
        count += at(depth_, end++);
      }
      if (count > 0) {
        record_columns(first, last, begin, end, static_cast<std::size_t>(count));
      }
      begin = end;
    }
  }

  /// Makes, sorts and records the lists of the pixels from column `begin` up to `end`.
  void record_columns(const Span* first, const Span* last, int begin, int end, std::size_t count) {
    cancellation_.throw_if_canceled();
    const int row = first->row;
    if (samples_.size() < count) {
      samples_.resize(count);
    }
    list_end_.resize(static_cast<std::size_t>(end - begin));
    std::size_t first_sample = 0;
    for (int column = begin; column < end; ++column) {
      at(list_end_, column - begin) = first_sample;
      first_sample += static_cast<std::size_t>(at(depth_, column));
    }
    for (const Span* span = first; span < last; ++span) {
      for (int x = std::max(span->begin, begin); x < std::min(span->end, end); ++x) {
        samples_[at(list_end_, x - begin)++] = {span->patch,
                                                heights_.height(span->patch, grid_.center(x, row))};
      }
    }
    Sample* list = samples_.data();
    for (int column = begin; column < end; ++column) {
      Sample* const list_end = samples_.data() + at(list_end_, column - begin);
      Sample* const lowest = heights_.sort(list, list_end);
      if (!std::equal(list, lowest, span_.begin(), span_.end(),
                      [](const Sample& sample, PatchId patch) { return sample.patch == patch; })) {
        record_span(row, column);
        span_.clear();
        for (const Sample* sample = list; sample < lowest; ++sample) {
          span_.push_back(sample->patch);
        }
        span_begin_ = column;
      }
      list = list_end;
    }
    record_span(row, end);
    span_.clear();
  }

  /// Records a run of neighboring pixels with the same list at once.
  void record_span(int row, int end) {
    PatchId above = no_patch;
    for (const PatchId patch : span_) {
      sink_.record(row, span_begin_, end, patch, above);
      above = patch;
    }
  }

  const Outlines& outlines_;
  std::span<const std::int32_t> numbers_;
  const PixelGrid& grid_;
  const PatchHeights& heights_;
  VisibilitySink& sink_;
  const Cancellation& cancellation_;
  ScanConverter converter_;
  std::vector<Span> spans_;            ///< spans of the current band
  std::vector<std::int64_t> depth_;    ///< number of patches over each pixel of the current row
  std::vector<Sample> samples_;        ///< samples of a part of a row, pixel by pixel
  std::vector<std::size_t> list_end_;  ///< in samples_, by pixel
  std::vector<PatchId> span_;          ///< the list of the pixels from span_begin_
  int span_begin_ = 0;
};

}  // namespace

void fill_zbuffer(const Scene& scene, const PixelGrid& grid, const PatchHeights& heights,
                  VisibilitySink& sink, const Cancellation& cancellation) {
  std::vector<std::int32_t> all(scene.pieces().size());
  std::iota(all.begin(), all.end(), 0);
  ZBuffer(PieceOutlines(scene, grid), all, grid, heights, sink, cancellation).fill();
}

void fill_zbuffer(const BspTree& tree, std::span<const FragmentId> fragments, const PixelGrid& grid,
                  const PatchHeights& heights, VisibilitySink& sink,
                  const Cancellation& cancellation) {
  ZBuffer(SnappedFragments(tree, grid), fragments, grid, heights, sink, cancellation).fill();
}

}  // namespace transillum
