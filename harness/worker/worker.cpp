#include "worker/worker.hpp"

#include <fcntl.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <memory>
#include <optional>

#include "cell/cell_runner.hpp"
#include "cell/description.hpp"
#include "cell/worlds_runner.hpp"
#include "conform/memory_host.hpp"
#include "conform/request.hpp"
#include "record/pair_tour.hpp"
#include "simulation/names.hpp"

namespace plumb::harness {

namespace {

Progress* map_progress() {
  void* memory = mmap(nullptr, sizeof(Progress), PROT_READ | PROT_WRITE, MAP_SHARED, worker_progress, 0);
  return memory == MAP_FAILED ? nullptr : static_cast<Progress*>(memory);
}

void write_answer(const Json& answer) {
  const std::string line = line_of(answer) + "\n";
  std::size_t sent = 0;
  while (sent < line.size()) {
    const ssize_t count = write(worker_answers, line.data() + sent, line.size() - sent);
    if (count <= 0) std::_Exit(0);  // the parent is gone: nobody waits for clean-up
    sent += static_cast<std::size_t>(count);
  }
}

// The backend is opened at the first request, so that what goes wrong has somebody to tell.
class Server {
 public:
  Server(std::string backend_file, Progress& progress) : file_(std::move(backend_file)), progress_(progress) {}

  Json answer(const Json& request) {
    try {
      if (!backend_) backend_.emplace(open_backend(file_, host_for(request)));
    } catch (const Error& error) {
      return {{"status", "error"}, {"reason", error.what()}};
    }
    const std::string what = request.at("request");
    if (what == "describe") return describe(*backend_);
    if (what == "conform") return conform::answer_request(*backend_, request);
    if (what == "pairs") return answer_pair_request(*backend_, request);
    if (what == "worlds") return run_worlds(*backend_, request, progress_);
    return run_cell(*backend_, request, progress_);
  }

 private:
  /// Checks want to know what memory is taken; nobody else's memory is counted.
  static const PlumbHost* host_for(const Json& request) {
    return request.at("request") == "conform" ? conform::MemoryHost::instance().host() : nullptr;
  }

  std::string file_;
  Progress& progress_;
  std::optional<Backend> backend_;
};

}  // namespace

int serve_as_worker(const std::string& backend_file) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  for (const int descriptor : {worker_requests, worker_answers, worker_progress})
    fcntl(descriptor, F_SETFD, FD_CLOEXEC);
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> requests(fdopen(worker_requests, "r"), std::fclose);
  Progress* progress = map_progress();
  if (!requests || progress == nullptr) {
    std::fputs("plumb worker serves a running plumb and is not for use by hand\n", stderr);
    return 2;
  }
  std::setvbuf(stdout, nullptr, _IOLBF, 0);  // what a backend prints before it crashes is worth having
  Server server(backend_file, *progress);
  char* line = nullptr;
  std::size_t size = 0;
  while (getline(&line, &size, requests.get()) > 0) write_answer(server.answer(Json::parse(line)));
  std::free(line);
  return 0;
}

}  // namespace plumb::harness
