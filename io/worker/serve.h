#pragma once

#include <string>

#include "io/worker/channel.h"
#include "io/worker/shared_buffer.h"
#include "io/worker/wire.h"

namespace volumen::worker {

/// A function that a worker runs: it reads its arguments, computes and writes its answer.
using Handler = void (*)(Wire& arguments, Wire& answer);

/// Initialises the tables, decoders and character sets that libraries load on first use. Without `all` it
/// prepares only those that most headers need. The zygote calls it once for each, as workers cannot open
/// files.
void prepareToServe(bool all);

/// Thrown by needAll(): a worker prepared for all must serve the request.
struct Unprepared {};

/// Must be called in a worker before anything is used that only prepareToServe(true) prepares. Does nothing
/// in other processes.
void needAll();

/// Serves requests until the program ends the worker or is gone itself.
[[noreturn]] void serve(int socket, SharedBuffer buffer, bool preparedForAll);

/// Returns whether this process is a worker.
bool inside();

/// A file that a worker has opened.
struct OpenedFile {
  Descriptor file;
  std::uint64_t size = 0;
};
Result<OpenedFile> openInside(const std::string& path);

/// Calls resolveBeside (io/files/data_file.h) by asking the program. For workers only.
Result<std::string> resolveInside(const std::string& headerPath, const std::string& name);

/// Reports in a worker that a step of the request is done. Does nothing in other processes.
void finishStep();

}  // namespace volumen::worker
