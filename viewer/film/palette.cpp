// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Selects 256 colors by variance-based cuts (Wan, Wong and Prusinkiewicz 1988): the box of colors
// with the largest sum of squared deviations is divided at its mean along the channel with the
// largest one. Colors are counted in cells of 4 × 4 × 4 levels.
#include "film/palette.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

namespace transillum::viewer {

namespace {

constexpr int color_count = 256, cell_bits = 6, cell_shift = 8 - cell_bits;

std::size_t cell_of(QRgb color) {
  return static_cast<std::size_t>((qRed(color) >> cell_shift << 2 * cell_bits) |
                                  (qGreen(color) >> cell_shift << cell_bits) |
                                  (qBlue(color) >> cell_shift));
}

/// The pixels of a cell.
struct Cell {
  std::size_t number = 0;
  double pixels = 0;
  std::array<double, 3> mean{};
};

/// A range of cells, and how they deviate from their mean.
struct Box {
  std::vector<Cell>::iterator first, last;
  std::array<double, 3> mean{}, deviation{};  ///< by channel; sum of squares over the pixels

  Box(std::vector<Cell>::iterator begin, std::vector<Cell>::iterator end)
      : first(begin), last(end) {
    double pixels = 0;
    std::array<double, 3> sum{}, squares{};
    for (auto cell = first; cell != last; ++cell) {
      pixels += cell->pixels;
      for (std::size_t c = 0; c < 3; ++c) {
        sum[c] += cell->pixels * cell->mean[c];
        squares[c] += cell->pixels * cell->mean[c] * cell->mean[c];
      }
    }
    for (std::size_t c = 0; c < 3; ++c) {
      mean[c] = sum[c] / pixels;
      deviation[c] = last - first > 1 ? std::max(0.0, squares[c] - sum[c] * mean[c]) : 0;
    }
  }
  double largest() const { return *std::max_element(deviation.begin(), deviation.end()); }
};

std::vector<Cell> cells_of(const QImage& picture) {
  struct Sums {
    std::uint32_t pixels = 0;
    std::array<std::uint32_t, 3> channels{};
  };
  std::vector<Sums> sums(std::size_t{1} << 3 * cell_bits);
  for (int y = 0; y < picture.height(); ++y) {
    const auto* row = reinterpret_cast<const QRgb*>(picture.constScanLine(y));
    std::for_each(row, row + picture.width(), [&](QRgb color) {
      Sums& sum = sums[cell_of(color)];
      ++sum.pixels;
      sum.channels[0] += static_cast<std::uint32_t>(qRed(color));
      sum.channels[1] += static_cast<std::uint32_t>(qGreen(color));
      sum.channels[2] += static_cast<std::uint32_t>(qBlue(color));
    });
  }
  std::vector<Cell> cells;
  for (std::size_t k = 0; k < sums.size(); ++k) {
    if (const Sums& sum = sums[k]; sum.pixels > 0) {
      Cell& cell = cells.emplace_back(Cell{k, static_cast<double>(sum.pixels), {}});
      std::transform(sum.channels.begin(), sum.channels.end(), cell.mean.begin(),
                     [&](std::uint32_t channel) { return channel / cell.pixels; });
    }
  }
  return cells;
}

std::vector<Box> boxes_of(std::vector<Cell>& cells) {
  std::vector<Box> boxes{{cells.begin(), cells.end()}};
  while (boxes.size() < color_count) {
    const auto box = std::max_element(boxes.begin(), boxes.end(), [](const Box& a, const Box& b) {
      return a.largest() < b.largest();
    });
    if (box->largest() <= 0) {
      break;
    }
    const auto channel = static_cast<std::size_t>(
        std::max_element(box->deviation.begin(), box->deviation.end()) - box->deviation.begin());
    const auto middle = std::partition(box->first, box->last, [&](const Cell& cell) {
      return cell.mean[channel] < box->mean[channel];
    });
    if (middle == box->first || middle == box->last) {
      box->deviation = {};  // rounding errors only
      continue;
    }
    const Box second(middle, box->last);
    *box = Box(box->first, middle);
    boxes.push_back(second);
  }
  return boxes;
}

}  // namespace

QImage with_palette(const QImage& picture) {
  std::vector<Cell> cells = cells_of(picture);
  QVector<QRgb> colors;
  std::vector<std::uint8_t> index(std::size_t{1} << 3 * cell_bits);
  for (const Box& box : boxes_of(cells)) {
    std::for_each(box.first, box.last, [&](const Cell& cell) {
      index[cell.number] = static_cast<std::uint8_t>(colors.size());
    });
    colors.append(qRgb(static_cast<int>(std::lround(box.mean[0])),
                       static_cast<int>(std::lround(box.mean[1])),
                       static_cast<int>(std::lround(box.mean[2]))));
  }
  colors.resize(color_count);
  QImage indexed(picture.size(), QImage::Format_Indexed8);
  indexed.setColorTable(colors);
  for (int y = 0; y < picture.height(); ++y) {
    const auto* row = reinterpret_cast<const QRgb*>(picture.constScanLine(y));
    std::transform(row, row + picture.width(), indexed.scanLine(y),
                   [&](QRgb color) { return index[cell_of(color)]; });
  }
  return indexed;
}

}  // namespace transillum::viewer
