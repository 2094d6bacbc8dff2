// Guards design.md 3 in the window: OpenGL resamples on the render thread, and the CPU does if OpenGL is
// unavailable.
#include <cmath>

#include <QSignalSpy>

#include "tests/fixtures/need_gl.h"
#include "tests/unit/suite.h"
#include "ui/controller/draw_service.h"
#include "ui/controller/qt_gl_context.h"
#include "viewer/phantoms/phantoms.h"

using namespace volumen;

class TestOpenGlResampler : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void theSamePictureComesFromOpenGl();
};

namespace {

// Returns the next full picture.
ScreenPicture fullPicture(DrawService& service, const Scene& scene) {
  ScreenPicture full;
  const auto connection = QObject::connect(&service, &DrawService::screenPictureReady, &service,
                                           [&](const ScreenPicture& picture) {
                                             if (!picture.draft()) full = picture;
                                           });
  service.request(0, scene, {80, 60});
  [&] { QTRY_VERIFY_WITH_TIMEOUT(!full.image.isNull(), 60000); }();
  QObject::disconnect(connection);
  return full;
}

// Returns the RMS difference of 8-bit colours.
double rmsDifference(const QImage& a, const QImage& b) {
  double squares = 0;
  for (int y = 0; y < a.height(); ++y)
    for (int x = 0; x < a.width(); ++x) {
      const QRgb p = a.pixel(x, y), q = b.pixel(x, y);
      for (const int d : {qRed(p) - qRed(q), qGreen(p) - qGreen(q), qBlue(p) - qBlue(q)}) squares += d * d;
    }
  return std::sqrt(squares / (3.0 * a.width() * a.height()));
}

}  // namespace

void TestOpenGlResampler::theSamePictureComesFromOpenGl() {
  const bool hasGl = makeOffscreenGlSurface();
  DrawService service(drawWithCaches);
  QSignalSpy failures(&service, &DrawService::failed);
  service.show(0, *makePhantom("ct-head:48"));
  const Scene scene;
  const ScreenPicture cpu = fullPicture(service, scene);
  service.setResampler(Resampler::gl);
  const ScreenPicture gl = fullPicture(service, scene);
  QCOMPARE(cpu.plan->resampler, Resampler::cpu);
  // The CPU goes from cell to cell and OpenGL takes plain steps. Both keep the promise of `standard`: 42 dB,
  // an RMSE of 2.03/255 each.
  QVERIFY(rmsDifference(cpu.image, gl.image) <= 4.06);
  if (!failures.isEmpty()) {
    QVERIFY2(!hasGl && !tests::whyNoGl().isEmpty(), "there is OpenGL, so nothing may fail");
    QCOMPARE(gl.plan->resampler, Resampler::cpu);
    QSKIP(qPrintable(failures[0][1].toString()));
  }
  QCOMPARE(gl.plan->resampler, Resampler::gl);
}

VOLUMEN_TEST(TestOpenGlResampler);
#include "tst_opengl_resampler.moc"
