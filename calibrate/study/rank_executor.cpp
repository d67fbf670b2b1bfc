#include <chrono>
#include <future>
#include <optional>
#include <stdexcept>
#include <string>
#include <thread>

#include <fmt/format.h>
#include <mpi.h>

#include "base/input_error.h"
#include "calibrate/study/executor.h"

namespace repose::calibrate {
namespace {

constexpr int kJob = 1, kDone = 2, kError = 3, kRelease = 4;

// MPI's own waiting would occupy a core that the simulations need.
constexpr std::chrono::milliseconds kBetweenLooks{2};

struct Message {
  int rank = 0;
  int tag = 0;
  std::string text;
};

void send(int rank, int tag, const std::string& text) {
  MPI_Send(text.data(), static_cast<int>(text.size()), MPI_CHAR, rank, tag, MPI_COMM_WORLD);
}

/// A message that has arrived; std::nullopt if there is none.
std::optional<Message> receive() {
  int is_there = 0;
  MPI_Status status;
  MPI_Iprobe(MPI_ANY_SOURCE, MPI_ANY_TAG, MPI_COMM_WORLD, &is_there, &status);
  if (is_there == 0) return std::nullopt;
  int size = 0;
  MPI_Get_count(&status, MPI_CHAR, &size);
  Message message{.rank = status.MPI_SOURCE, .tag = status.MPI_TAG, .text = {}};
  message.text.resize(static_cast<std::size_t>(size));
  MPI_Recv(message.text.data(), size, MPI_CHAR, status.MPI_SOURCE, status.MPI_TAG, MPI_COMM_WORLD,
           MPI_STATUS_IGNORE);
  return message;
}

RunResult run_of_rank(const std::string& text) {
  try {
    return run_in(text);
  } catch (const base::InputError& error) {
    throw std::runtime_error(
        fmt::format("another process sent a run that cannot be read: {}. Fix: start the same "
                    "version everywhere.",
                    error.what()));
  }
}

/// Rank 0's processing of one list of jobs.
class Farm {
 public:
  Farm(const std::vector<Job>& jobs, const JobDone& done, const StudySimulator& simulator,
       int ranks, const std::atomic<bool>& is_interrupted)
      : jobs_(jobs),
        done_(done),
        simulator_(simulator),
        is_interrupted_(is_interrupted),
        at_work_(static_cast<std::size_t>(ranks)) {}

  void run() {
    while (!is_over()) {
      const bool has_begun = hand_out();
      const bool has_finished = look_at_own();
      const bool has_heard = look_at_others();
      if (!has_begun && !has_finished && !has_heard) std::this_thread::sleep_for(kBetweenLooks);
    }
    if (!error_.empty()) throw base::InputError({.value = error_});
  }

 private:
  bool is_stopping() const { return is_interrupted_ || !error_.empty(); }

  /// Waits for busy ranks even when interrupted: an unreceived reply would be mistaken for one of
  /// the next list.
  bool is_over() const {
    const bool is_all_begun = next_ == jobs_.size() || is_stopping();
    return is_all_begun && busy_ == 0;
  }

  bool hand_out() {
    bool has_begun = false;
    for (std::size_t rank = at_work_.size(); rank-- > 0;) {
      if (at_work_[rank] || next_ == jobs_.size() || is_stopping()) continue;
      at_work_[rank] = next_++;
      ++busy_;
      has_begun = true;
      const Job& job = jobs_[*at_work_[rank]];
      if (rank == 0) {
        own_ = std::async(std::launch::async,
                          [this, &job] { return simulator_.simulate(job, is_interrupted_); });
      } else {
        send(static_cast<int>(rank), kJob, text_of(job));
      }
    }
    return has_begun;
  }

  bool look_at_own() {
    if (!own_.valid() || own_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) {
      return false;
    }
    try {
      finish(0, own_.get());
    } catch (const dem::Interrupted&) {
      release(0);
    } catch (const base::InputError& error) {
      error_ = error.what();
      release(0);
    }
    return true;
  }

  bool look_at_others() {
    const std::optional<Message> message = receive();
    if (!message) return false;
    const auto rank = static_cast<std::size_t>(message->rank);
    if (message->tag == kDone) {
      finish(rank, run_of_rank(message->text));
    } else {
      if (!message->text.empty()) error_ = message->text;
      release(rank);
    }
    return true;
  }

  void finish(std::size_t rank, const RunResult& result) {
    const std::size_t job = at_work_[rank].value();
    release(rank);
    done_(job, result);
  }

  void release(std::size_t rank) {
    at_work_[rank].reset();
    --busy_;
  }

  const std::vector<Job>& jobs_;
  const JobDone& done_;
  const StudySimulator& simulator_;
  const std::atomic<bool>& is_interrupted_;
  std::vector<std::optional<std::size_t>> at_work_;  ///< the job of each rank
  std::future<RunResult> own_;
  std::size_t next_ = 0;
  int busy_ = 0;
  std::string error_;
};

}  // namespace

bool has_ranks() { return true; }

RankSession::RankSession() {
  int provided = 0;
  MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &provided);
  if (provided < MPI_THREAD_FUNNELED) {
    throw std::runtime_error(
        "MPI of this machine cannot be used by a program with threads. Fix: start it without "
        "mpirun.");
  }
  MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
  MPI_Comm_size(MPI_COMM_WORLD, &ranks_);
}

RankSession::~RankSession() {
  if (rank_ == 0) {
    for (int rank = 1; rank < ranks_; ++rank) send(rank, kRelease, {});
  }
  MPI_Finalize();
}

void RankSession::serve(const StudySimulator& simulator,
                        const std::atomic<bool>& is_interrupted) const {
  for (;;) {
    const std::optional<Message> message = receive();
    if (!message) {
      std::this_thread::sleep_for(kBetweenLooks);
      continue;
    }
    if (message->tag == kRelease) return;
    try {
      send(0, kDone, text_of(simulator.simulate(job_in(message->text), is_interrupted)));
    } catch (const dem::Interrupted&) {
      send(0, kError, {});
    } catch (const std::exception& error) {
      send(0, kError, error.what());
    }
  }
}

void RankExecutor::run(const std::vector<Job>& jobs, const JobDone& done,
                       const std::atomic<bool>& is_interrupted) {
  Farm(jobs, done, simulator_, session_.ranks(), is_interrupted).run();
}

}  // namespace repose::calibrate
