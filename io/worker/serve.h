#pragma once

#include <string>

#include "io/worker/channel.h"
#include "io/worker/shared_buffer.h"
#include "io/worker/wire.h"

namespace volumen::worker {

/// What a worker is asked to run: reads its arguments, runs, writes what came of it.
using Handler = void (*)(Wire& arguments, Wire& answer);

/// Touches what libraries load when they are first used: tables, decoders, character sets. Done once, in the
/// zygote: workers cannot open files.
void prepareToServe();

/// Serves requests until the program ends the worker or is gone.
[[noreturn]] void serve(int socket, SharedBuffer buffer);

/// Whether this process is a worker.
bool inside();

/// In a worker: opens a file that the request is about, by asking the program.
struct OpenedFile {
  Descriptor file;
  std::uint64_t size = 0;
};
Result<OpenedFile> openInside(const std::string& path);

/// In a worker: resolveBeside (io/files/data_file.h), by asking the program.
Result<std::string> resolveInside(const std::string& headerPath, const std::string& name);

/// In a worker: says that a step of the request is done; elsewhere nothing.
void finishStep();

}  // namespace volumen::worker
