// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Changes of materials by the number of a face where faces were joined: numbers have gaps.
#include <memory>

#include "model/material_edits.h"
#include "registered.h"
#include "transillum/errors.h"

namespace transillum::viewer::face_numbers_test {

namespace {

/// Three squares, faces 0, 2 and 4 of a file with six triangles.
std::shared_ptr<const Scene> joined_scene() {
  SceneDescription d;
  d.name = "strip";
  d.materials = {{"gray", {0.5, 0.5, 0.5}, {}}};
  for (int k = 0; k < 3; ++k) {
    const double x = 2 * k;
    const auto first = static_cast<PointId>(d.points.size());
    d.points.insert(d.points.end(), {{x, 0, 0}, {x + 1, 0, 0}, {x + 1, 1, 0}, {x, 1, 0}});
    d.add_face(std::vector<PointId>{first, first + 1, first + 2, first + 3}, 0);
    d.face_number.push_back(2 * k);
  }
  d.joined_to = {0, 0, 2, 2, 4, 4};
  return std::make_shared<const Scene>(d, SceneOptions{.two_sided = true});
}

std::vector<double> exitances(const MaterialEdits& edits) {
  std::vector<double> all;
  for (PatchId i = 0; i < 6; ++i) {
    all.push_back(edits.materials()->of(i).exitance.r);
  }
  return all;
}

}  // namespace

class FaceNumbersTest : public QObject {
  Q_OBJECT

 private slots:
  void a_change_is_of_the_patches_with_the_number() {
    QUndoStack undo;
    MaterialEdits edits(undo);
    edits.start_with(joined_scene());
    edits.set_exitance("face:2", {7, 7, 7});
    QVERIFY((exitances(edits) == std::vector<double>{0, 0, 7, 7, 0, 0}));
    QCOMPARE(edits.extent_of("face:2").patches, 2);
    undo.undo();
    QVERIFY(!edits.any());
  }

  void a_joined_face_is_refused_with_what_it_became() {
    QUndoStack undo;
    MaterialEdits edits(undo);
    edits.start_with(joined_scene());
    const auto misfits =
        edits.start_over({{"face:3", {}, Rgb{7, 7, 7}}, {"face:4", {}, Rgb{1, 1, 1}}});
    QCOMPARE(misfits.size(), std::size_t{1});
    QVERIFY(QString::fromStdString(misfits.front()).contains("face 3 was joined to face 2"));
    QVERIFY((exitances(edits) == std::vector<double>{0, 0, 0, 0, 1, 1}));
    QVERIFY_EXCEPTION_THROWN(edits.set_exitance("face:3", {2, 2, 2}), InputError);
    edits.set_exitance("face:0", {3, 3, 3});
    QVERIFY((exitances(edits) == std::vector<double>{3, 3, 0, 0, 1, 1}));
  }
};

const test::Registered registered("face_numbers", test::run_without_application<FaceNumbersTest>);

}  // namespace transillum::viewer::face_numbers_test

#include "face_numbers_test.moc"
