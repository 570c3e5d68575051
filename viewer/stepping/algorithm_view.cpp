// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// The panel of the paper's pseudo-code. Lines and values come from algorithm_state.h, for the
// position in Focus and the newest snapshot.
#include "stepping/algorithm_view.h"

#include <QComboBox>
#include <QLabel>
#include <QRegularExpression>
#include <QStringList>
#include <algorithm>
#include <utility>

#include "support/number_text.h"
#include "widgets/build.h"
#include "widgets/elided.h"
#include "widgets/scrolling.h"
#include "widgets/theme.h"
#include "widgets/value_grid.h"

namespace transillum::viewer {

namespace {

QLabel* heading(const QString& text) {
  auto* label = new QLabel(text);
  label->setContentsMargins(12, 6, 12, 2);
  label->setForegroundRole(QPalette::PlaceholderText);
  return label;
}

// The text with indices below and above the line, which it writes as "B_i" and "T^ab".
QString typeset(const QString& text) {
  static const QRegularExpression lower(QStringLiteral("_([a-z]+)")),
      upper(QStringLiteral("\\^([a-z]+)"));
  return text.toHtmlEscaped()
      .replace(lower, QStringLiteral("<sub>\\1</sub>"))
      .replace(upper, QStringLiteral("<sup>\\1</sup>"));
}

// Wrapped lines keep their indentation.
QLabel* code_line(const QString& text, int indent) {
  auto* label = new QLabel(typeset(text));
  label->setTextFormat(Qt::RichText);
  label->setWordWrap(true);
  label->setContentsMargins(14 + 16 * indent, 1, 8, 1);
  return label;
}

// Whether a line of code names a symbol: A in "A(j)/A_i", i in "A_i", but not in "if".
bool names(const QString& line, const QString& symbol) {
  return !symbol.isEmpty() &&
         line.contains(QRegularExpression(QStringLiteral("(?<![A-Za-z])%1(?![A-Za-z])")
                                              .arg(QRegularExpression::escape(symbol))));
}

// A table of three by three numbers.
QString moments_text(const TransferMoments& moments) {
  QString rows;
  for (std::size_t a = 0; a < 3; ++a) {
    QString cells;
    for (std::size_t b = 0; b < 3; ++b) {
      cells += QStringLiteral("<td align=right>%1</td>").arg(number_text(moments.of(a, b)));
    }
    rows += QStringLiteral("<tr>%1</tr>").arg(cells);
  }
  return QStringLiteral("<table cellspacing=6>%1</table>").arg(rows);
}

QString role_text(bool front_facing) {
  return front_facing ? AlgorithmView::tr("receiver") : AlgorithmView::tr("source");
}

}  // namespace

AlgorithmView::AlgorithmView(const Focus& focus, const Selection& selection, QWidget* parent)
    : QWidget(parent), focus_(focus), selection_(selection) {
  kind_ = named("map_kind", new ElidedComboBox);
  kind_->addItem(tr("Local visibility map (section 3.2)"));
  kind_->addItem(tr("Global visibility map (section 3.1)"));
  kind_->setMinimumContentsLength(20);
  kind_->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
  auto* chooser = make_row({12, 8, 12, 4});
  chooser->addWidget(kind_);

  auto* layout = make_column(this, {0, 2, 0, 8}, 0);
  layout->addWidget(heading(tr("All directions (section 3.3)")));
  layout->addWidget(make_code(CodeLine::start, CodeLine::each_direction));
  layout->addWidget(heading(tr("One direction")));
  layout->addLayout(chooser);
  local_widgets_ = {make_code(CodeLine::sort, CodeLine::put_in), make_local_values()};
  global_widgets_ = {make_code(CodeLine::global_map, CodeLine::gather_region),
                     make_region_values()};
  for (const auto& parts : {local_widgets_, global_widgets_}) {
    for (QWidget* part : parts) {
      layout->addWidget(part);
    }
  }
  hidden_note_ = heading(tr("The answer to the page's question reveals the values (Ctrl+Return)."));
  hidden_note_->setObjectName("values_hidden");
  hidden_note_->setWordWrap(true);
  layout->addWidget(hidden_note_);
  layout->addStretch(1);
  connect(kind_, qOverload<int>(&QComboBox::currentIndexChanged), this, &AlgorithmView::show_kind);
  connect(&focus_, &Focus::moved, this, &AlgorithmView::show_position);
  connect(&focus_, &Focus::probed, this, &AlgorithmView::show_position);
  connect(&selection_, &Selection::changed, this, &AlgorithmView::show_position);
  show_kind();
}

QWidget* AlgorithmView::make_code(CodeLine first, CodeLine last) {
  auto* box = new QWidget;
  auto* layout = make_column(box, {}, 0);
  for (const CodeText& text : algorithm_code()) {
    if (text.line < first || text.line > last) {
      continue;
    }
    lines_.push_back(code_line(text.text, text.indent));
    layout->addWidget(lines_.back());
  }
  return box;
}

QWidget* AlgorithmView::make_local_values() {
  values_ = new ValueGrid;
  values_->layout()->setContentsMargins(12, 10, 12, 4);
  position_ = values_->add_row(
      tr("n, d"), {},
      tr("n: index of the B(n) that the iteration starts from, beginning with 0 as in the paper; "
         "d: number of the direction"));
  i_ = values_->add_row(tr("i"), {}, tr("The patch whose fragment this step processes"));
  i_->setObjectName("value_i");
  map_ = values_->add_row(
      tr("V"), {},
      symbol_tip(tr("The visibility map: number of its polygons before and after the step"),
                 "5.1"));
  lists_ = values_->add_row(tr("I, O"), {},
                            tr("Number of polygons in the inside list and in the outside list"));
  j_ = values_->add_row(
      tr("j, A(j)"), tr("m²"),
      symbol_tip(tr("The selected patch if i receives from it, or else the patch with "
                    "the largest A(j), the area of j that i sees"),
                 "5.1"));
  j_->setObjectName("value_j");
  weight_ = values_->add_row(
      typeset(tr("J_d, M")), {},
      symbol_tip(tr("Weight and number of directions; a two-way pass counts as two"), "6"));
  radiosity_ =
      values_->add_row(typeset(tr("B_j(n)")), tr("W/m²"), tr("Radiosity of j: red, green, blue"));
  gathered_ = values_->add_row(
      tr("Σ"), tr("W/m²"),
      symbol_tip(tr("Amount that the step adds to Bᵢ(n+1), by eq. 11, before row normalization"),
                 "2"));
  gathered_->setObjectName("value_gathered");
  for (QLabel* value : {i_, radiosity_, gathered_}) {
    value->setWordWrap(true);
  }
  moments_grid_ = new ValueGrid;
  moments_ = moments_grid_->add_row(
      typeset(tr("T^ab")), tr("m²"),
      symbol_tip(
          tr("Moments of the area that i sees of j: ∫ φ_a(x) φ_b(y) dp over A(j), where x and y "
             "are the points of i and j.\nRows: function a of i; columns: function b of j. "
             "The first value is A(j). The rest of its row weights the linear term of j\nin "
             "the mean of i, the rest of its column weights the mean of j in the linear term of i"),
          "6.12"));
  moments_->setObjectName("value_moments");
  values_->add_wide(moments_grid_);
  return values_;
}

QWidget* AlgorithmView::make_region_values() {
  region_hint_ =
      new QLabel(tr("Click the map to choose a region R, which is then highlighted. Stepping goes "
                    "down its list L."));
  region_hint_->setWordWrap(true);
  region_hint_->setForegroundRole(QPalette::PlaceholderText);
  region_values_ = new ValueGrid;
  region_values_->layout()->setContentsMargins(12, 10, 12, 4);
  region_ = region_values_->add_row(
      tr("R"), tr("m"), tr("The point clicked (u, v); the map highlights the region around it"));
  region_area_ =
      region_values_->add_row(tr("A(R)"), tr("m²"),
                              symbol_tip(tr("Area of the region around the point, bounded by all "
                                            "polygon edges, visible or hidden"),
                                         "5.3"));
  region_area_->setObjectName("value_region_area");
  region_list_ = region_values_->add_row(
      tr("L"), {}, tr("The patches that cover R, the nearest to the source first"));
  region_list_->setWordWrap(true);
  region_list_->setObjectName("value_region_list");
  region_i_ = region_values_->add_row(tr("i"), {}, tr("The patch of L that was processed last"));
  region_i_->setObjectName("value_region_i");
  region_j_ = region_values_->add_row(
      tr("j, Σ A(R)"), tr("m²"),
      tr("The next patch j above i, and the area of j that i sees in all regions"));
  region_j_->setObjectName("value_region_j");
  region_radiosity_ = region_values_->add_row(typeset(tr("B_j(n)")), tr("W/m²"),
                                              tr("Radiosity of j: red, green, blue"));
  region_gathered_ = region_values_->add_row(
      tr("+="), tr("W/m²"), tr("Amount that R adds to Bᵢ(n+1), before row normalization"));
  region_gathered_->setObjectName("value_region_gathered");
  for (QLabel* value : {region_radiosity_, region_gathered_}) {
    value->setWordWrap(true);
  }
  auto* box = new QWidget;
  auto* layout = make_column(box, {});
  auto* hint = make_row({12, 8, 12, 0});
  hint->addWidget(region_hint_);
  layout->addLayout(hint);
  layout->addWidget(region_values_);
  return box;
}

MapKind AlgorithmView::kind() const {
  return kind_->currentIndex() == 0 ? MapKind::local : MapKind::global;
}

void AlgorithmView::set_kind(MapKind kind) {
  kind_->setCurrentIndex(kind == MapKind::local ? 0 : 1);
}

void AlgorithmView::show_kind() {
  for (const MapKind shown : {MapKind::local, MapKind::global}) {
    // The code, and its values.
    const auto& parts = shown == MapKind::local ? local_widgets_ : global_widgets_;
    parts.front()->setVisible(kind() == shown);
    parts.back()->setVisible(kind() == shown && !values_hidden_);
  }
  hidden_note_->setVisible(values_hidden_);
  show_position();
}

void AlgorithmView::set_values_hidden(bool hidden) {
  values_hidden_ = hidden;
  show_kind();
}

void AlgorithmView::point_at(const QString& symbol) {
  pointed_ = symbol;
  show_position();
}

void AlgorithmView::show_snapshot(std::shared_ptr<const SolverSnapshot> snapshot) {
  snapshot_ = std::move(snapshot);
  show_position();
}

void AlgorithmView::show_position() {
  const auto current = current_lines(focus_, kind());
  for (std::size_t k = 0; k < lines_.size(); ++k) {
    const CodeLine line = algorithm_code()[k].line;
    const bool on = std::find(current.begin(), current.end(), line) != current.end();
    const QString style = on ? QStringLiteral("background: %1; color: %2; font-weight: bold;")
                                   .arg(theme::processed.name(), theme::on_yellow.name())
                          : names(algorithm_code()[k].text, pointed_)
                              ? QStringLiteral("background: %1; color: %2;")
                                    .arg(theme::region.name(), theme::on_yellow.name())
                              : QString();
    if (lines_[k]->styleSheet() != style) {
      lines_[k]->setStyleSheet(style);
    }
    if (on) {
      scroll_to(lines_[k]);
    }
  }
  if (kind() == MapKind::local) {
    const auto state =
        snapshot_ ? algorithm_state(focus_, *snapshot_, selection_.patch()) : std::nullopt;
    enable_if(*values_, state.has_value(), tr("No step is shown"));
    show_values(state.value_or(AlgorithmState()));
    emit region_shown({});
  } else {
    const auto state = snapshot_ ? region_state(focus_, *snapshot_) : std::nullopt;
    enable_if(*region_values_, state.has_value(), tr("No step is shown"));
    region_hint_->setVisible(!state.has_value());
    show_region(state.value_or(RegionState()));
    emit region_shown(state ? state->region : std::nullopt);
  }
}

void AlgorithmView::show_region(const RegionState& state) {
  constexpr std::size_t max_listed = 24;
  const QString none = QStringLiteral("–");
  QStringList list;
  for (std::size_t k = 0; k < std::min(state.list.size(), max_listed); ++k) {
    list << QString::number(state.list[k]);
  }
  if (state.list.size() > max_listed) {
    list << QStringLiteral("…");
  }
  region_->setText(list.isEmpty()
                       ? none
                       : tr("%1, %2").arg(number_text(state.point.x), number_text(state.point.y)));
  region_list_->setText(list.isEmpty() ? none : list.join(QStringLiteral(", ")));
  region_i_->setText(state.i == no_patch ? none
                                         : tr("%1, %2").arg(QString::number(state.i),
                                                            role_text(state.front_facing)));
  region_j_->setText(state.j == no_patch ? none
                     : state.exchanges
                         ? tr("%1, %2").arg(QString::number(state.j), number_text(state.pair_area))
                         : tr("%1, no exchange").arg(state.j));
  region_area_->setText(state.region ? number_text(state.region->area) : none);
  region_radiosity_->setText(state.radiosity_j ? rgb_text(*state.radiosity_j) : none);
  region_gathered_->setText(state.gathered ? rgb_text(*state.gathered) : none);
}

void AlgorithmView::show_values(const AlgorithmState& state) {
  const QString none = QStringLiteral("–");
  const bool has_i = state.i != no_patch, has_j = state.j != no_patch;
  const RunPosition& position = focus_.position();
  position_->setText(
      focus_.map() ? tr("%1, %2").arg(position.iteration).arg(count_text(position.direction + 1))
                   : none);
  i_->setText(has_i ? tr("%1, A = %2 m², %3")
                          .arg(QString::number(state.i), number_text(state.area_i),
                               role_text(state.front_facing))
                    : none);
  map_->setText(has_i ? tr("%1 → %2").arg(count_text(state.map_before), count_text(state.map_after))
                      : none);
  lists_->setText(has_i ? tr("%1, %2").arg(count_text(state.inside), count_text(state.outside))
                        : none);
  j_->setText(has_j ? tr("%1, %2").arg(QString::number(state.j), number_text(state.area_j)) : none);
  weight_->setText(has_i ? tr("4π, %1").arg(count_text(state.directions)) : none);
  radiosity_->setText(state.radiosity_j ? rgb_text(*state.radiosity_j) : none);
  gathered_->setText(state.gathered ? rgb_text(*state.gathered) : none);
  moments_grid_->setVisible(state.moments.has_value());
  moments_->setText(state.moments ? moments_text(*state.moments) : none);
}

}  // namespace transillum::viewer
