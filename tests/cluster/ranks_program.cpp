// Ranks put to work: ranks_program CASE[,CASE...] [RANK]. Rank 0 prints each case when it begins.
// Each rank leaves the code that it ends with in code.RANK; a check that does not hold is an error
// of that rank. Run by ranks_test.py.
#include <fmt/format.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <thread>

#include "cluster/collect.h"
#include "cluster/ranks.h"
#include "cluster/tasks.h"
#include "rholm/error.h"

namespace rholm {
namespace {

using namespace std::chrono_literals;

// Small, so that few bytes come in many pieces.
constexpr std::size_t kPiece = 1000;

std::atomic<int> stop_signal = 0;
std::atomic<std::uint64_t> progress = 0;

void expect(bool holds, const std::string& what) {
  if (!holds) throw Error(ErrorCode::kUnsupported, "not so: " + what);
}

// Bytes that nobody else sends.
std::string bytes_of(std::size_t size, int salt) {
  std::string bytes(size, '\0');
  for (std::size_t i = 0; i < size; ++i) {
    bytes[i] = static_cast<char>((i * 7 + i / 251 + static_cast<std::size_t>(salt) * 13) & 0xff);
  }
  return bytes;
}

void collect(Ranks& ranks) {
  for (const std::size_t size : {0, 1, 999, 1000, 4096, 4097, 50001}) {
    for (int round = 0; round < 3; ++round) {
      const std::string sent = ranks.rank() == 0 ? bytes_of(size, round) : "";
      expect(broadcast(ranks, sent) == bytes_of(size, round), fmt::format("{} to all", size));
      const auto all =
          gather(ranks, bytes_of(size + static_cast<std::size_t>(ranks.rank()), round));
      expect(all.size() == (ranks.rank() == 0 ? static_cast<std::size_t>(ranks.size()) : 0), "all");
      for (std::size_t i = 0; i < all.size(); ++i) {
        expect(all[i] == bytes_of(size + i, round), fmt::format("{} of rank {}", size, i));
      }
    }
    barrier(ranks);
  }
}

// Messages of all sizes to the next rank (itself, if there is one rank only).
void order(Ranks& ranks) {
  const int to = (ranks.rank() + 1) % ranks.size();
  for (int i = 0; i < 500; ++i) {
    ranks.send(to, Tag::kTest, bytes_of(static_cast<std::size_t>(i * 37 % 9001), i));
  }
  for (int i = 0; i < 500; ++i) {
    expect(ranks.receive(Tag::kTest).bytes == bytes_of(static_cast<std::size_t>(i * 37 % 9001), i),
           fmt::format("message {} in its place", i));
  }
  barrier(ranks);
}

void large(Ranks& ranks) {
  const std::size_t size = (std::size_t{1} << 31) + 4321;
  const std::string got = broadcast(ranks, ranks.rank() == 0 ? bytes_of(size, 1) : "");
  expect(got.size() == size, "all bytes");
  for (std::size_t i = 0; i < size; i += 997) {
    expect(got[i] == static_cast<char>((i * 7 + i / 251 + 13) & 0xff), fmt::format("byte {}", i));
  }
  barrier(ranks);
}

constexpr std::uint64_t kTasks = 300, kWide = 5;

// A task and what it is done on.
using Work = std::function<void(Ranks& ranks, std::uint64_t task)>;

void tasks(Ranks& ranks, const Work& extra, const std::function<void(std::uint64_t)>& on_take) {
  const DoTask work = [&](std::uint64_t task, int threads) {
    expect(threads == (task < kWide ? 2 : 1), "wide tasks have all threads");
    extra(ranks, task);
    ++progress;
    return bytes_of(task * 31 % 6000, static_cast<int>(task));
  };
  if (ranks.rank() != 0) return serve_tasks(ranks, 2, work);
  TaskList list;
  for (std::uint64_t i = 0; i < kTasks; ++i) (i < kWide ? list.wide : list.narrow).push_back(i);
  std::map<std::uint64_t, int> times;
  lead_tasks(ranks, list, 2, work, [&](std::uint64_t task, const std::string& bytes) {
    expect(bytes == bytes_of(task * 31 % 6000, static_cast<int>(task)), "what the task gave");
    ++times[task];
    on_take(task);
  });
  expect(times.size() == kTasks, "all tasks are done");
  for (const auto& [task, n] : times) expect(n == 1, fmt::format("task {} once", task));
}

// Results come in their order, of the rank that had to do the task if they are dealt, and no task
// is begun far ahead of them; nothing is taken after `last`.
void ordered(Ranks& ranks, bool dealt, std::uint64_t last) {
  constexpr int kThreads = 2;
  const auto size = static_cast<std::uint64_t>(ranks.size());
  std::atomic<std::uint64_t> next = 0;  // on rank 0
  const DoTask work = [&](std::uint64_t task, int threads) {
    expect(threads == 1, "one thread a task");
    expect(ranks.rank() != 0 || dealt || task < next + 2 * kThreads * size, "not far ahead");
    if (task % 50 == 7) std::this_thread::sleep_for(20ms);  // the others get ahead of it
    ++progress;
    const auto size_of_it = static_cast<std::size_t>(task * 31 % 6000);
    return std::to_string(ranks.rank()) + ":" + bytes_of(size_of_it, static_cast<int>(task));
  };
  if (ranks.rank() != 0) return serve_tasks(ranks, kThreads, work);
  const OrderedTasks tasks{.count = kTasks, .dealt = dealt};
  lead_tasks(ranks, tasks, kThreads, work, [&](std::uint64_t task, const std::string& bytes) {
    expect(task == next && task <= last, "the next result");
    ++next;
    const auto colon = bytes.find(':');
    const auto rank = std::stoull(bytes.substr(0, colon));
    expect(!dealt || (task >= rank * kTasks / size && task < (rank + 1) * kTasks / size), "dealt");
    expect(bytes.substr(colon + 1) ==
               bytes_of(static_cast<std::size_t>(task * 31 % 6000), static_cast<int>(task)),
           "what the task gave");
    return task != last;
  });
  expect(next == std::min(kTasks, last + 1), "all results are taken");
}

void nothing(std::uint64_t) {}

// Work that gets on, and ends when the rank is told to.
void until_stopped() {
  while (stop_signal == 0) {
    ++progress;
    std::this_thread::sleep_for(1ms);
  }
}

// Others see it once it is complete. Tests look for names by their beginning: the part has another
// one.
void write_whole(const std::string& name, const std::string& text) {
  const std::string part =
      fmt::format("part.{}.{}", std::hash<std::thread::id>()(std::this_thread::get_id()), name);
  std::ofstream(part) << text;
  std::filesystem::rename(part, name);
}

void run_case(Ranks& ranks, const std::string& name, int chosen) {
  const auto is_chosen = [&](const Ranks& here) { return here.rank() == chosen; };
  // On a busy machine the others would do all tasks before the chosen rank asks for one: from some
  // task on they wait for it.
  const auto wait_for_chosen = [&](const Ranks& here, std::uint64_t task) {
    while (!is_chosen(here) && task > 20 && !std::filesystem::exists("met")) {
      ++progress;
      std::this_thread::sleep_for(1ms);
    }
  };
  if (name == "collect") {
    collect(ranks);
  } else if (name == "order") {
    order(ranks);
  } else if (name == "large") {
    large(ranks);
  } else if (name == "tasks") {
    for (int round = 0; round < 3; ++round) {
      tasks(
          ranks, [](Ranks&, std::uint64_t) {}, nothing);
      barrier(ranks);  // nobody asks for the next tasks before these have ended
    }
  } else if (name == "ordered") {
    for (const bool dealt : {false, true}) {
      for (const std::uint64_t last : {kTasks, kTasks / 3, std::uint64_t{0}}) {
        ordered(ranks, dealt, last);
        barrier(ranks);  // nobody asks for the next tasks before these have ended
      }
    }
  } else if (name == "throws") {  // in a task, while others have some
    std::atomic<int> n = 0;
    const Work work = [&](const Ranks& here, std::uint64_t task) {
      wait_for_chosen(here, task);
      if (is_chosen(here) && ++n == 3) {
        write_whole("met", {});
        throw Error(ErrorCode::kInvalidInput, "a bad file");
      }
      std::this_thread::sleep_for(1ms);
    };
    tasks(ranks, work, nothing);
  } else if (name == "throws-at-once") {  // all ranks, each its own error
    throw Error(ErrorCode::kInvalidInput, fmt::format("bad file {}", ranks.rank()));
  } else if (name == "does-not-take") {
    const Work slow = [](Ranks&, std::uint64_t task) {
      if (task > 20) until_stopped();
    };
    tasks(ranks, slow, [](std::uint64_t task) {
      if (task == 20) throw Error(ErrorCode::kIo, "the disk is full");
    });
  } else if (name == "stuck") {  // alive, but its task does not end
    ranks.set_patience(3);
    const Work work = [&](const Ranks& here, std::uint64_t task) {
      wait_for_chosen(here, task);
      if (!is_chosen(here)) return;
      write_whole("met", {});
      while (true) std::this_thread::sleep_for(10ms);
    };
    tasks(ranks, work, nothing);
  } else if (name == "slow") {  // as long as need be
    const Work work = [](const Ranks& here, std::uint64_t) {
      write_whole(fmt::format("works.{}", here.rank()), std::to_string(getpid()));
      until_stopped();
    };
    ranks.set_patience(5);
    tasks(ranks, work, nothing);
  } else if (name == "leaves") {  // rank 0 has nothing for the others
    if (ranks.rank() != 0) ranks.receive(Tag::kTest);
  } else {
    throw Error(ErrorCode::kUnsupported, "no such case: " + name);
  }
}

Ending ending_of(const std::exception_ptr& what) {
  try {
    std::rethrow_exception(what);
  } catch (const Error& error) {
    return {error.code() == ErrorCode::kInvalidInput ? 3 : 1, error.what()};
  } catch (const std::exception& error) {
    return {1, error.what()};
  }
}

// All cases in one run; every case but the last ends with a barrier.
void run_cases(Ranks& ranks, const std::string& names, int chosen) {
  std::stringstream list(names);
  for (std::string name; std::getline(list, name, ',');) {
    if (ranks.rank() == 0) {
      fmt::print("{}\n", name);
      std::fflush(stdout);
    }
    run_case(ranks, name, chosen);
  }
}

int run(const std::string& names, int chosen) {
  Ranks ranks({.progress = [] { return progress.load(); },
               .interrupted = [] { return stop_signal.load(); },
               .stop = [](int code) { stop_signal = code == 0 ? 0 : SIGTERM; },
               .error = [](const std::string& text) { fmt::print(stderr, "error: {}\n", text); },
               .ended = [](const RankTotals& t) { fmt::print("{} ranks\n", t.ranks); },
               .discard = {},
               .ending_of = ending_of},
              names == "large" ? std::size_t{1} << 30 : kPiece);
  ranks.set_hint([] { return std::string("go on so"); });
  const int code = ranks.run(
      [&](Ranks& all) {
        run_cases(all, names, chosen);
        return Ending{};
      },
      [&](Ranks& all) {
        run_cases(all, names, chosen);
        all.receive(Tag::kTest);  // until rank 0 has ended
      });
  std::ofstream(fmt::format("code.{}", ranks.rank())) << code;
  return code;
}

}  // namespace
}  // namespace rholm

int main(int argc, char** argv) {
  std::signal(SIGTERM, [](int signal) { rholm::stop_signal = signal; });
  std::signal(SIGINT, [](int signal) { rholm::stop_signal = signal; });
  return argc < 2 ? 2 : rholm::run(argv[1], argc < 3 ? 0 : std::stoi(argv[2]));
}
