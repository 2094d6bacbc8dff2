#include "tests/bench/scale_run.h"

#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <stdexcept>

extern char** environ;

namespace volumen::bench {

namespace {

double secondsOf(const timeval& time) { return double(time.tv_sec) + double(time.tv_usec) / 1e6; }

}  // namespace

Taken runTimed(std::vector<std::string> words) {
  std::array<int, 2> ends{};
  if (pipe(ends.data()) != 0) throw std::runtime_error("no pipe");
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, ends[1], 1);
  posix_spawn_file_actions_addclose(&actions, ends[0]);
  posix_spawn_file_actions_addclose(&actions, ends[1]);
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  pid_t pid = -1;
  const int started = posix_spawnp(&pid, arguments[0], &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  close(ends[1]);
  Taken taken;
  std::array<char, 4096> part{};
  for (ssize_t got; started == 0 && (got = read(ends[0], part.data(), part.size())) > 0;)
    taken.out.append(part.data(), std::size_t(got));
  close(ends[0]);
  int status = -1;
  rusage usage{};
  if (started == 0) wait4(pid, &status, 0, &usage);
  if (status != 0) throw std::runtime_error(words[0] + ' ' + words[1] + " failed");
  taken.seconds = secondsOf(usage.ru_utime) + secondsOf(usage.ru_stime);
  taken.mebibytes = double(usage.ru_maxrss) / 1024;
  return taken;
}

void apart(const std::function<void()>& work) {
  const pid_t pid = fork();
  if (pid == 0) {
    try {
      work();
      _exit(0);
    } catch (const std::exception& e) {
      std::fprintf(stderr, "%s\n", e.what());
      _exit(1);
    }
  }
  int status = -1;
  if (pid > 0) waitpid(pid, &status, 0);
  if (status != 0) throw std::runtime_error("the data could not be made");
}

}  // namespace volumen::bench
