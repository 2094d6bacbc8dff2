#include "ui/controller/registration_jobs.h"

#include "viewer/register/rigid_registration.h"

namespace volumen {

RegistrationJobs::RegistrationJobs(Jobs& jobs, QObject* parent) : QObject(parent), lane_(&jobs) {}

void RegistrationJobs::cancel() {
  lane_.giveUpAll();
  pair_.reset();
}

void RegistrationJobs::start(const PlacedVolume& fixed, const PlacedVolume& moving) {
  cancel();
  pair_.emplace(fixed.frame, moving.frame);
  lane_.run(
      tr("Registering"),
      [fixed, moving](const Job& job) {
        return registerRigidly(*fixed.volume, *moving.volume, job.cancel());
      },
      [this, fixed, moving](const Result<Rigid>& rigid) {
        pair_.reset();
        if (rigid)
          Q_EMIT found(fixed.frame, moving.frame, *rigid);
        else
          Q_EMIT failed(QString::fromStdString(rigid.message()));
      },
      [this] { pair_.reset(); });
}

}  // namespace volumen
