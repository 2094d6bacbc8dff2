// Guards design.md 8: after a real drag, a slow picture is preceded by a finer draft, and both are shown.
#include <QSignalSpy>
#include <QThread>

#include "tests/ui/gestures.h"
#include "tests/unit/suite.h"
#include "ui/main_window.h"
#include "ui/views/volume_view.h"
#include "viewer/scene/presets.h"

using namespace volumen;

namespace {

constexpr int waitMs = 60000;  // ms, for a loaded machine

// Draws pictures of one grey at 6 us per pixel.
Draw slowDraw(const VoxelsPtr&) {
  const auto plan = [](const Scene& scene, const RenderOptions& options, const CancelToken&) {
    Planned planned;
    planned.plan.scene = scene;
    planned.plan.options = options;
    return Result<Planned>(planned);
  };
  const auto picture = [](const Planned& planned, const CancelToken& cancel) -> Result<Drawn> {
    Drawn drawn;
    drawn.plan = planned.plan;
    drawn.picture.size = planned.plan.options.size;
    drawn.picture.rgba.assign(std::size_t(4) * drawn.picture.size.x * drawn.picture.size.y, 0.5f);
    for (int y = 0; y < drawn.picture.size.y; ++y) {
      if (cancel.cancelled()) return Error{"cancelled"};
      QThread::usleep(6UL * unsigned(drawn.picture.size.x));
    }
    return drawn;
  };
  return {plan, picture};
}

}  // namespace

class TestFinerDraft : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void aDragEndsInAFinerDraftAndThenTheFinalPicture();
};

void TestFinerDraft::aDragEndsInAFinerDraftAndThenTheFinalPicture() {
  Services services = realServices();
  services.makeDraw = slowDraw;
  MainWindow window(services);
  QSignalSpy settled(&window, &MainWindow::settled);
  window.resize(1040, 680);
  window.show();
  window.open({QStringLiteral("phantom:sphere:16")});
  QTRY_VERIFY_WITH_TIMEOUT(!settled.isEmpty(), waitMs);

  std::vector<ScreenPicture> pictures;
  bool allShown = true;
  connect(&window.drawService(), &DrawService::screenPictureReady, &window,
          [&](const ScreenPicture& picture) {
            pictures.push_back(picture);
            allShown = allShown && window.view()->picture() == picture.image;
          });
  settled.clear();
  tests::drag(window.view(), {150, 150}, {190, 170});
  QTRY_VERIFY_WITH_TIMEOUT(!settled.isEmpty(), waitMs);
  QVERIFY(allShown);
  QVERIFY(pictures.size() >= 3);
  const ScreenPicture &draft = pictures[pictures.size() - 3], &finer = pictures[pictures.size() - 2],
                      &rest = pictures.back();
  QVERIFY(rest.atRest && rest.factor == 1);
  QVERIFY(finer.draft() && finer.quality == Quality::draft && finer.factor < draft.factor);
  QVERIFY2(draft.scene == finer.scene && finer.scene == rest.scene, "nothing jumps");
}

VOLUMEN_TEST(TestFinerDraft);
#include "tst_finer_draft.moc"
