// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "window/files/color_export_dialog.h"

#include <QCheckBox>
#include <QComboBox>
#include <QDialogButtonBox>
#include <QDoubleSpinBox>
#include <QFormLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QPixmap>
#include <QPushButton>
#include <QSignalBlocker>
#include <QVBoxLayout>
#include <utility>

#include "state/camera_views.h"
#include "support/number_text.h"
#include "widgets/build.h"
#include "widgets/theme.h"

namespace transillum::viewer {

namespace {

constexpr int picture_width = 480, picture_height = 340;
constexpr int rays_per_pixel_side = 2;

struct Format {
  const char *ending, *text;
  bool is_gltf;  ///< has a vertical, and textures
};
constexpr Format formats[] = {
    {".glb", QT_TRANSLATE_NOOP("ColorExportDialog", "glTF, one file (.glb)"), true},
    {".gltf", QT_TRANSLATE_NOOP("ColorExportDialog", "glTF, as text (.gltf)"), true},
    {".ply", QT_TRANSLATE_NOOP("ColorExportDialog", "PLY with colors of vertices (.ply)"), false}};

}  // namespace

ColorExportDialog::ColorExportDialog(std::shared_ptr<const SolverSnapshot> snapshot,
                                     const ViewPoint& view, const Vec3& up, QWidget* parent)
    : QDialog(parent),
      preview_(*this, &unlit_view,
               [this](const UnlitRequest&, std::shared_ptr<const UnlitView> unlit,
                      const QString& error) {
                 view_ = std::move(unlit);
                 picture_->setText(error);
                 show_state();
               }) {
  setObjectName("color_export_dialog");
  setWindowTitle(tr("Export for Blender or the web"));
  picture_ = make_picture();
  make_fields(up);
  auto* form = new QFormLayout;
  form->addRow(tr("Format"), format_);
  form->addRow(tr("Scene's vertical"), up_);
  auto* exposure_row = new QHBoxLayout;
  exposure_row->addWidget(exposure_, 1);
  exposure_row->addWidget(automatic_);
  form->addRow(tr("Exposure"), exposure_row);
  form->addRow(tr("Colors"), light_map_);
  form->addRow(QString(), note_);
  auto* buttons = new QDialogButtonBox(QDialogButtonBox::Cancel);
  QPushButton* go_on = buttons->addButton(tr("Export…"), QDialogButtonBox::AcceptRole);
  go_on->setObjectName("export_colors_go_on");
  go_on->setDefault(true);
  auto* layout = new QVBoxLayout(this);
  layout->setSpacing(12);
  layout->addWidget(picture_);
  layout->addLayout(form);
  layout->addWidget(buttons);
  layout->setSizeConstraint(QLayout::SetFixedSize);
  connect(buttons, &QDialogButtonBox::accepted, this, &QDialog::accept);
  connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
  show_state();
  const QSize rays = rays_per_pixel_side * QSize(picture_width, picture_height);
  preview_.request({std::move(snapshot), view.eye, view.target, view.up, view.view_angle, rays});
}

QLabel* ColorExportDialog::make_picture() {
  auto* picture = named("color_preview", new QLabel(tr("Drawing the preview…")));
  picture->setFixedSize(picture_width, picture_height);
  picture->setAlignment(Qt::AlignCenter);
  picture->setWordWrap(true);
  picture->setAutoFillBackground(true);
  QPalette palette = picture->palette();
  palette.setColor(QPalette::Window, theme::scene_background);
  palette.setColor(QPalette::WindowText, theme::on_dark);
  picture->setPalette(palette);
  picture->setToolTip(
      tr("Preview from the current viewpoint. Colors are linear, without lighting; back sides are "
         "transparent"));
  return picture;
}

void ColorExportDialog::make_fields(const Vec3& up) {
  format_ = named("color_format", new QComboBox);
  for (const Format& format : formats) {
    format_->addItem(tr(format.text));
  }
  up_ = named("color_up", new QComboBox);
  for (const NamedAxis& axis : named_axes()) {
    up_->addItem(QString::fromUtf8(axis.name));
    if (axis.direction == up) {
      up_->setCurrentIndex(up_->count() - 1);
    }
  }
  up_->setToolTip(tr("The direction that becomes up (+y) in glTF"));
  exposure_ = named("color_exposure", new QDoubleSpinBox,
                    tr("A patch is white if its B times the exposure is 1 or more"));
  exposure_->setDecimals(6);
  exposure_->setRange(1e-6, 1e9);
  exposure_->setValue(1);
  exposure_->setStepType(QAbstractSpinBox::AdaptiveDecimalStepType);
  exposure_->setSuffix(tr(" m²/W"));
  automatic_ =
      named("color_automatic", new QCheckBox(tr("automatic")),
            tr("Choose the exposure so that 98 % of the area that does not emit is below white"));
  automatic_->setChecked(true);
  light_map_ =
      named("color_light_map", new QCheckBox(tr("as a light map")),
            tr("glTF: a picture with texture coordinates, a square of it per patch, instead of a "
               "color per corner; for programs that ignore colors of corners"));
  note_ = named("color_note_of_export", note_label());
  note_->setMinimumHeight(2 * note_->fontMetrics().lineSpacing());
  connect(format_, qOverload<int>(&QComboBox::currentIndexChanged), this,
          &ColorExportDialog::show_state);
  connect(automatic_, &QCheckBox::toggled, this, &ColorExportDialog::show_state);
  connect(exposure_, qOverload<double>(&QDoubleSpinBox::valueChanged), this,
          &ColorExportDialog::show_state);
}

double ColorExportDialog::exposure() const {
  return automatic_->isChecked() && view_ ? view_->automatic_exposure : exposure_->value();
}

void ColorExportDialog::show_state() {
  for (QWidget* of_gltf : std::initializer_list<QWidget*>{up_, light_map_}) {
    enable_if(*of_gltf, formats[format_->currentIndex()].is_gltf, tr("This format has none"));
  }
  enable_if(*exposure_, !automatic_->isChecked(), tr("The exposure is chosen automatically"));
  if (!view_) {
    return;
  }
  if (automatic_->isChecked()) {
    const QSignalBlocker quiet(exposure_);
    exposure_->setValue(view_->automatic_exposure);
  }
  const double percent = 100 * view_->white_fraction(exposure());
  note_->setText(tr("White from B = %1 W/m² on: %2 % of the area that does not emit")
                     .arg(number_text(1 / exposure()), QString::number(percent, 'f', 1)));
  const double ratio = devicePixelRatioF();
  QImage picture = view_->picture(exposure(), theme::scene_background.rgb())
                       .scaled(QSize(static_cast<int>(picture_width * ratio),
                                     static_cast<int>(picture_height * ratio)),
                               Qt::IgnoreAspectRatio, Qt::SmoothTransformation);
  picture.setDevicePixelRatio(ratio);
  picture_->setPixmap(QPixmap::fromImage(picture));
}

QString ColorExportDialog::ending() const {
  return QString::fromLatin1(formats[format_->currentIndex()].ending);
}

DisplayOptions ColorExportDialog::display() const {
  DisplayOptions options;
  if (!automatic_->isChecked()) {
    options.exposure = exposure_->value();
  }
  options.light_map = light_map_->isEnabled() && light_map_->isChecked();
  const Vec3& up = named_axes()[static_cast<std::size_t>(up_->currentIndex())].direction;
  if (up_->isEnabled() && !(up == Vec3{0, 1, 0})) {  // +y is up in glTF
    options.up = up;
  }
  return options;
}

}  // namespace transillum::viewer
