// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// The section "Why this number?" of the panel of a patch. Its numbers come from light_balance() of
// the newest snapshot and the patch's row of form factors.
#include "patches/balance_view.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "model/snapshot_values.h"
#include "state/breakpoints.h"
#include "support/number_text.h"
#include "transillum/at.h"
#include "widgets/theme.h"

namespace transillum::viewer {

namespace {

QString link_to(const QString& target, const QString& text, const QString& tip) {
  return QStringLiteral("<a href='%1' title='%2' style='color:%3;text-decoration:none'>%4</a>")
      .arg(target, tip, theme::accent.name(), text);
}

QString cell(const QString& text, const char* align = "right") {
  return QStringLiteral("<td align='%1' style='white-space:nowrap'>%2</td>")
      .arg(QLatin1String(align), text);
}

QString figures(const QString& text) {
  return QStringLiteral(
             "<td align='right' style='font-family:monospace;white-space:nowrap'>%1</td>")
      .arg(text);
}

/// A number that leads to a panel, which tells more of it.
QString number_in(const char* panel, const QString& number) {
  return link_to(QStringLiteral("panel:") + QLatin1String(panel), number,
                 BalanceView::tr("Show where it comes from"));
}

/// A symbol with a real index: B with i below the line.
QString symbol(const char* letter, const QString& index) {
  return QStringLiteral("<i>%1</i><sub>%2</sub>").arg(QString::fromUtf8(letter), index);
}

QString source_name(const Scene& scene, const LightBalance::Term& term) {
  const Patch& patch = scene.patch(term.largest);
  if (term.patches.size() == 1) {
    return BalanceView::tr("patch %1").arg(term.largest);
  }
  const auto count = count_text(static_cast<std::int64_t>(term.patches.size()));
  return patch.group == no_group
             ? BalanceView::tr("face %1 (%2)").arg(QString::number(patch.face), count)
             : BalanceView::tr("%1 (%2)").arg(
                   QString::fromStdString(at(scene.groups(), patch.group)).toHtmlEscaped(), count);
}

}  // namespace

BalanceView::BalanceView(Focus& focus, Selection& selection, QWidget* parent)
    : QLabel(parent),
      focus_(focus),
      selection_(selection),
      rows_(
          *this,
          [this](const RowRequest& request, const Cancellation& cancellation) {
            return compute(request, cancellation);
          },
          [this] { refresh(); }, CurrentJob::cancel) {
  setObjectName("balance");
  setTextFormat(Qt::RichText);
  setWordWrap(true);
  setAlignment(Qt::AlignTop);
  setTextInteractionFlags(Qt::TextBrowserInteraction);
  connect(this, &QLabel::linkActivated, this, &BalanceView::follow);
  connect(&focus_, &Focus::seek_stopped, this, [this] { disconnect(other_way_); });
}

void BalanceView::show_balance(std::shared_ptr<const SolverSnapshot> snapshot, PatchId patch) {
  snapshot_ = std::move(snapshot);
  patch_ = patch;
  refresh();
}

void BalanceView::showEvent(QShowEvent* event) {
  QLabel::showEvent(event);
  refresh();
}

void BalanceView::refresh() {
  if (!snapshot_ || patch_ < 0 || patch_ >= snapshot_->loaded->scene->patch_count()) {
    rows_.clear();
    setText({});
    return;
  }
  if (!isVisible()) {
    return;
  }
  const std::optional<RowRequest> request = row_request(*snapshot_, patch_);
  if (!request) {
    setText(why_no_form_factors(*snapshot_));
    emit form_factors_requested();
    return;
  }
  if (request == canceled_) {
    setText(tr("Not computed.") + QLatin1Char(' ') +
            link_to(QStringLiteral("compute"), tr("Compute"), {}));
    return;
  }
  canceled_.reset();
  rows_.request(*request);
  if (has_row()) {
    balance_ = light_balance(*snapshot_, patch_, rows_.result()->row);
    show_text();
  } else if (!rows_.error().isEmpty()) {
    setText(rows_.error());
  } else {
    show_progress();
  }
}

bool BalanceView::has_row() const {
  const std::shared_ptr<const PatchRow> row = rows_.result();
  return row && row->loaded == snapshot_->loaded && row->receiver == patch_;
}

void BalanceView::show_progress() {
  setText(tr("Finding the form factors of patch %1… %2 %").arg(patch_).arg(percent_) +
          QLatin1Char(' ') + link_to(QStringLiteral("cancel"), tr("Cancel"), {}));
}

PatchRow BalanceView::compute(const RowRequest& request, const Cancellation& cancellation) {
  int shown = -1;
  return compute_row(request, cancellation, [&](double fraction) {
    const int percent = static_cast<int>(100 * fraction);
    if (percent == shown || cancellation.canceled()) {
      return;
    }
    shown = percent;
    const auto show = [this, percent, receiver = request.receiver] {
      percent_ = percent;
      if (rows_.busy() && receiver == patch_ && isVisible() && !has_row()) {
        show_progress();
      }
    };
    QMetaObject::invokeMethod(this, show, Qt::QueuedConnection);
  });
}

double BalanceView::channel_of(const Rgb& value) const {
  return channel_ == 0 ? value.r : channel_ == 1 ? value.g : value.b;
}

QString BalanceView::equation() const {
  const QString i = QString::number(balance_.receiver), j = QStringLiteral("j");
  const double b = channel_of(balance_.radiosity), e = channel_of(balance_.exitance);
  const double rho = channel_of(balance_.reflectance);
  QStringList channels;
  for (const QString& name : {tr("red"), tr("green"), tr("blue")}) {
    const auto channel = channels.size();
    channels << (channel == channel_
                     ? QStringLiteral("<b>%1</b>").arg(name)
                     : link_to(QStringLiteral("channel:%1").arg(channel), name, {}));
  }
  return QStringLiteral(
             "<p>%1 = %2 + %3 Σ<sub>j</sub> %4 %5</p>"
             "<p style='font-family:monospace'>%6 = %7 + %8 × %9 W/m²</p>")
             .arg(symbol("B", i), symbol("E", i), symbol("ρ", i), symbol("F", i + ',' + j),
                  symbol("B", j), number_in("table", number_text(b)),
                  number_in("material", number_text(e)), number_in("material", number_text(rho)),
                  rho > 0 ? number_in("received", number_text((b - e) / rho))
                          : QStringLiteral("–")) +
         QStringLiteral("<p>%1</p>").arg(channels.join(QStringLiteral(" · ")));
}

QString BalanceView::row(const QString& source, const QString& form_factor,
                         const QString& radiosity, const Amount& amount) const {
  const double all = channel_of(balance_.radiosity), light = channel_of(amount.light);
  const QString share = all > 0 ? QString::number(100 * light / all, 'f', 1) : QStringLiteral("–");
  return QStringLiteral("<tr>%1%2%3%4%5</tr>")
      .arg(cell(source, "left"), figures(form_factor), figures(radiosity),
           figures(link_to(amount.target, amount.text, amount.tip)),
           figures(link_to(amount.target, share, amount.tip)));
}

void BalanceView::show_text() {
  const Scene& scene = *snapshot_->loaded->scene;
  std::stable_sort(balance_.terms.begin(), balance_.terms.end(),
                   [this](const LightBalance::Term& a, const LightBalance::Term& b) {
                     return channel_of(a.contribution) > channel_of(b.contribution);
                   });
  double largest_f = 0, largest_b = 0;
  for (const LightBalance::Term& term : balance_.terms) {
    largest_f = std::max(largest_f, term.form_factor);
    largest_b = std::max(largest_b, channel_of(term.radiosity));
  }
  const ColumnFormat of_f(largest_f), of_b(largest_b), of_term(channel_of(balance_.radiosity));
  const QString i = QStringLiteral("i"), j = QStringLiteral("j"), ij = i + j;
  QString text =
      equation() + QStringLiteral("<table width='100%' cellpadding='1'><tr>%1%2%3%4%5</tr>")
                       .arg(cell(tr("source j"), "left"), cell(of_f.header(symbol("F", ij))),
                            cell(of_b.header(symbol("B", j))),
                            cell(of_term.header(symbol("ρ", i) + symbol("F", ij) + symbol("B", j))),
                            cell(QStringLiteral("%")));
  for (std::size_t k = 0; k < balance_.terms.size(); ++k) {
    const LightBalance::Term& term = balance_.terms[k];
    const auto to = [k](const char* what) {
      return QStringLiteral("%1:%2").arg(QLatin1String(what)).arg(k);
    };
    text += row(
        link_to(to("source"), source_name(scene, term), tr("Select its patches")),
        link_to(to("seen"), of_f.text(term.form_factor), tr("The directions in which it was seen")),
        link_to(to("source"), of_b.text(channel_of(term.radiosity)), tr("Select it")),
        {term.contribution, of_term.text(channel_of(term.contribution)), to("step"),
         tr("A step that exchanges this light")});
  }
  const auto add = [&](const QString& name, const Rgb& value, const char* panel) {
    if (std::abs(channel_of(value)) > 1e-12 * channel_of(balance_.radiosity)) {
      text +=
          row(name, {}, {},
              {value, of_term.text(channel_of(value)),
               QStringLiteral("panel:") + QLatin1String(panel), tr("Show where it comes from")});
    }
  };
  add(tr("%1 others").arg(balance_.other_count), balance_.others, "table-partners");
  add(tr("first shot"), balance_.shot, "paths");
  add(tr("sky"), balance_.sky, "received");
  add(tr("sun"), balance_.sun, "received");
  add(symbol("E", i), balance_.exitance, "material");
  const bool renews = traits_of(snapshot_->options.scheme).renews_directions;
  const QString last = renews              ? tr("differences of iterations")
                       : snapshot_->glossy ? tr("lobes and last iteration")
                                           : tr("last iteration");
  add(last, balance_.remainder, "convergence");
  add(symbol("B", i), balance_.radiosity, "table");
  setText(text + QStringLiteral("</table>"));
}

void BalanceView::follow(const QString& link) {
  const QString what = link.section(':', 0, 0);
  const int number = link.section(':', 1).toInt();
  if (what == QLatin1String("cancel")) {
    canceled_ = row_request(*snapshot_, patch_);
    rows_.clear();
    refresh();
    return;
  }
  if (what == QLatin1String("compute")) {
    canceled_.reset();
    refresh();
    return;
  }
  if (what == QLatin1String("channel")) {
    channel_ = number;
    show_text();
    return;
  }
  if (what == QLatin1String("panel")) {
    show_panel(link.section(':', 1));
    return;
  }
  const LightBalance::Term term = balance_.terms[static_cast<std::size_t>(number)];
  if (what == QLatin1String("seen")) {
    emit directions_wanted(term.patches);
  } else if (what == QLatin1String("source")) {
    term.patches.size() == 1 ? selection_.select(term.largest)
                             : selection_.select_all(term.patches);
  } else {
    emit panel_wanted("map");
    seek_exchange_with(term.largest);
  }
}

void BalanceView::show_panel(const QString& name) {
  if (name.startsWith(QLatin1String("table"))) {
    emit table_wanted(name == QLatin1String("table-partners"));
  } else {
    emit panel_wanted(name.toStdString());
  }
}

// Back from the position, which is the newest as a rule, then forward to the end of the run.
void BalanceView::seek_exchange_with(PatchId source) {
  const Breakpoint pair{{Breakpoint::Kind::pair, balance_.receiver, source}};
  const StepFinder finder = find_where(
      [pair](const MapHistory& history, std::int32_t step) { return holds(pair, history, step); });
  disconnect(other_way_);
  other_way_ = connect(&focus_, &Focus::seek_ended, this, [this, finder](bool found) {
    const StepFinder other = finder;  // the connection owns `finder`
    disconnect(other_way_);
    if (!found) {
      focus_.seek(other, StepOrder::forward);
    }
  });
  focus_.seek(finder, StepOrder::backward);
}

}  // namespace transillum::viewer
