#include "io/archive/protocol.h"

namespace volumen {

Status ended(const Result<std::string>& refusal) {
  if (!refusal) return refusal.error();
  return refusal->empty() ? Status() : Error{*refusal};
}

std::unique_ptr<ArchiveProtocol> protocolOf(const Archive& archive, const CancelToken& cancel) {
  return archive.kind == ArchiveKind::dicomweb ? makeWebProtocol(archive, cancel)
                                               : makeDimseProtocol(archive, cancel);
}

}  // namespace volumen
