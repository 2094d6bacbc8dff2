// Guards previews of segment changes without a window: of tools, and of growth from seeds.
#include "tests/unit/controller/editing.h"
#include "tests/unit/suite.h"

using namespace volumen;
using namespace volumen::tests;

class TestSegmentPreviews : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void aPreviewChangesNothing();
  void aPreviewStaysUntilItIsMade();
  void aFailedPreviewIsSilent();
  void seedsGrowAsPreviewed();
  void thePreviewOfGrowthComesBack();
  void thePreviewOfGrowthEndsWithItsSeeds();
  void onlyOtherOptionsAreTold();
};

void TestSegmentPreviews::aPreviewChangesNothing() {
  Editing e;
  const Workspace before = e.session.workspace();
  e.editing.preview(e.lesion(6));
  QVERIFY(e.idle());
  QVERIFY(e.editing.previewed());
  QCOMPARE(maskOf(*e.editing.previewed()->labels, 1).count(), voxelsWhere(isSmall));
  QVERIFY(e.session.workspace() == before);
  e.editing.endPreview();
  QVERIFY(!e.editing.previewed());
  QVERIFY(e.answers.empty());
}

void TestSegmentPreviews::aPreviewStaysUntilItIsMade() {
  Editing e;
  e.editing.preview(e.lesion(6));
  QVERIFY(e.idle());
  e.editing.change(e.lesion(6));
  QVERIFY(e.editing.previewed());
  QVERIFY(e.idle());
  QVERIFY(!e.editing.previewed());
  QCOMPARE(e.mask().count(), voxelsWhere(isSmall));
}

void TestSegmentPreviews::aFailedPreviewIsSilent() {
  Editing e;
  e.editing.preview(e.lesion(6));
  QVERIFY(e.idle());
  e.editing.preview(e.lesion(1.5));
  QVERIFY(e.idle());
  QVERIFY(!e.editing.previewed());
  e.editing.preview(e.lesion(6));
  QVERIFY(e.idle());
  e.choose([](SegmentOptions& o) { o.lesionThreshold = {2.5, false}; });
  e.editing.preview(e.lesion(6));
  QVERIFY(!e.editing.previewed());
  QVERIFY(e.answers.empty());
}

void TestSegmentPreviews::seedsGrowAsPreviewed() {
  Editing e;
  e.add({400, 600});
  e.add({800, 1200});
  e.choose([](SegmentOptions& o) { o.growthRegion = GrowthRegion::everywhere; });
  e.choose([](SegmentOptions& o) { o.previewsGrowth = true; });
  QVERIFY(e.idle());
  QVERIFY(e.editing.previewed());
  const LabelMap previewed = *e.editing.previewed()->labels;
  e.editing.grow();
  QVERIFY(!e.editing.options().previewsGrowth);
  QVERIFY(e.idle());
  QVERIFY(*e.map()->labels == previewed);
  QVERIFY(!e.editing.previewed());
}

void TestSegmentPreviews::thePreviewOfGrowthComesBack() {
  Editing e;
  e.add({400, 600});
  e.add({3000, 4000});
  e.paint({15, -15, 15}, 2);
  e.choose([](SegmentOptions& o) { o.previewsGrowth = true; });
  QVERIFY(e.idle());
  const LabelMap growth = *e.editing.previewed()->labels;
  e.editing.preview(e.lesion(6));
  QVERIFY(e.idle());
  QVERIFY(*e.editing.previewed()->labels != growth);
  e.editing.endPreview();
  QVERIFY(e.idle());
  QVERIFY(*e.editing.previewed()->labels == growth);
  // Another seed grows at once.
  e.paint({-15, 15, 15}, 2);
  QVERIFY(e.idle());
  QVERIFY(*e.editing.previewed()->labels != growth);
}

void TestSegmentPreviews::thePreviewOfGrowthEndsWithItsSeeds() {
  Editing e;
  e.add({400, 600});
  e.add({800, 1200});
  e.choose([](SegmentOptions& o) { o.previewsGrowth = true; });
  QVERIFY(e.idle());
  e.changeCurrent([](Segment& s) { s.locked = true; });
  QVERIFY(!e.editing.options().previewsGrowth);
  QVERIFY(e.idle());
  QVERIFY(!e.editing.previewed());
  QVERIFY(e.answers.empty());
}

void TestSegmentPreviews::onlyOtherOptionsAreTold() {
  Editing e;
  int told = 0;
  QObject::connect(&e.editing, &SegmentEditing::optionsChanged, &e.editing, [&told] { ++told; });
  e.choose([](SegmentOptions& o) { o.erases = true; });
  e.choose([](SegmentOptions& o) { o.erases = true; });
  QCOMPARE(told, 1);
}

VOLUMEN_TEST(TestSegmentPreviews);
#include "tst_segment_previews.moc"
