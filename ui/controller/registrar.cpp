#include "ui/controller/registrar.h"

#include "viewer/register/rigid_registration.h"

namespace volumen {

Registrar::Registrar(QObject* parent) : QObject(parent) {
  pool_.setMaxThreadCount(1);
  watch_.setInterval(100);
  connect(&watch_, &QTimer::timeout, this, [this] { Q_EMIT progressed(cancel_.done()); });
}

Registrar::~Registrar() {
  cancel_.cancel();
  pool_.waitForDone();
}

void Registrar::cancel() {
  cancel_.cancel();
  cancel_ = CancelToken();
  pair_.reset();
}

void Registrar::start(const PlacedVolume& fixed, const PlacedVolume& moving) {
  cancel();
  pair_.emplace(fixed.frame, moving.frame);
  if (underWay_++ == 0) Q_EMIT begun();
  watch_.start();
  pool_.start([this, fixed, moving, token = cancel_] {
    const Result<Rigid> rigid = registerRigidly(*fixed.volume, *moving.volume, token);
    QMetaObject::invokeMethod(
        this,
        [this, fixed, moving, token, rigid] {
          if (--underWay_ == 0) {
            watch_.stop();
            Q_EMIT ended();
          }
          if (token.cancelled()) return;
          pair_.reset();
          if (rigid)
            Q_EMIT found(fixed.frame, moving.frame, *rigid);
          else
            Q_EMIT failed(QString::fromStdString(rigid.message()));
        },
        Qt::QueuedConnection);
  });
}

}  // namespace volumen
