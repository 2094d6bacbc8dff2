#include "io/archive/network_use.h"

#include <dcmtk/config/osconfig.h>
#include <dcmtk/oflog/oflog.h>

#include <csignal>
#include <mutex>

namespace volumen {

namespace {

std::mutex usersMutex;
int users = 0;
void (*pipeSignalBefore)(int) = SIG_DFL;

}  // namespace

NetworkUse::NetworkUse() {
  const std::lock_guard lock(usersMutex);
  if (users++ > 0) return;
  pipeSignalBefore = std::signal(SIGPIPE, SIG_IGN);
  for (const char* logger : {"dcmtk.dcmnet", "dcmtk.dcmtls", "dcmtk.dcmdata"})
    OFLog::getLogger(logger).setLogLevel(OFLogger::OFF_LOG_LEVEL);
}

NetworkUse::~NetworkUse() {
  const std::lock_guard lock(usersMutex);
  if (--users == 0) std::signal(SIGPIPE, pipeSignalBefore);
}

}  // namespace volumen
