#include "tests/unit/archive/taking_peer.h"

#include <algorithm>

namespace volumen::tests {

TakingPeer::TakingPeer(const QByteArrayList& syntaxes)
    : peer_(
          [this](ScpLine& line, const DimseMessage& request) {
            {
              const QMutexLocker one(&mutex_);
              dataSets_ << request.data;
            }
            line.send(responseTo(request));
          },
          [syntaxes](const ProposedContext& context) {
            const auto taken = std::ranges::find_if(context.syntaxes, [&](const QByteArray& syntax) {
              return syntaxes.isEmpty() || syntaxes.contains(syntax);
            });
            return taken == context.syntaxes.end() ? QByteArray() : *taken;
          }) {}

QByteArrayList TakingPeer::dataSets() const {
  const QMutexLocker one(&mutex_);
  return dataSets_;
}

}  // namespace volumen::tests
