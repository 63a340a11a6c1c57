// Runs cases on several ranks: ranks_program CASE[,CASE...] [RANK]. Rank 0 prints each case when it
// begins. Each rank writes its exit code to code.RANK. A check that fails is an error of that rank.
// The program is run by ranks_test.py.
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
#include "cluster/rank_executor.h"
#include "cluster/ranks.h"
#include "rholm/error.h"

namespace rholm {
namespace {

using namespace std::chrono_literals;

// Size in bytes of a block, so small that short messages are split into many blocks.
constexpr std::size_t kPiece = 1000;

std::atomic<int> stop_signal = 0;
std::atomic<std::uint64_t> progress = 0;

void expect(bool holds, const std::string& what) {
  if (!holds) throw Error(ErrorCode::kUnsupported, "not so: " + what);
}

// Returns bytes that no other rank sends.
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

// Sends messages of all sizes to the next rank (to itself, if there is only one rank).
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

constexpr std::size_t kParts = 300, kWide = 5;

std::string result_of(std::size_t part) {
  return bytes_of(part * 31 % 6000, static_cast<int>(part));
}

// The work for one part.
using Work = std::function<void(Ranks& ranks, std::size_t part)>;

void parts(Ranks& ranks, const Work& extra, const std::function<void(std::size_t)>& on_take) {
  std::map<std::size_t, int> times;
  RankExecutor(ranks, 2).run(
      {.count = kParts, .wide = kWide, .in_order = false},
      [&](std::size_t part, int threads) {
        expect(threads == (part < kWide ? 2 : 1), "wide parts have all threads");
        extra(ranks, part);
        ++progress;
        return result_of(part);
      },
      [&](std::size_t part, const std::string& bytes) {
        expect(ranks.rank() == 0, "rank 0 takes");
        expect(bytes == result_of(part), "what the part gave");
        ++times[part];
        on_take(part);
      });
  expect(times.size() == (ranks.rank() == 0 ? kParts : 0), "all parts are worked");
  for (const auto& [part, n] : times) expect(n == 1, fmt::format("part {} once", part));
}

// Results arrive in order. If parts are dealt, each result comes from the rank to which its part
// belongs. No part begins far ahead of the results. Part `wrong` has invalid input: rank 0 throws
// the error once, and takes no result from there on.
void ordered(Ranks& ranks, bool dealt, std::size_t count, std::size_t wrong) {
  constexpr int kThreads = 2;
  const auto size = static_cast<std::size_t>(ranks.size());
  std::atomic<std::size_t> next = 0;  // on rank 0
  std::string called;
  RankExecutor executor(ranks, kThreads, [&](const Parts& all) { called = all.job + all.input; });
  std::string thrown;
  try {
    executor.run(
        {.count = count, .dealt = dealt, .job = "a job", .input = " of it"},
        [&](std::size_t part, int threads) {
          expect(threads == 1, "one thread a part");
          expect(ranks.rank() != 0 || dealt || part < next + 2 * kThreads * size, "not far ahead");
          if (part % 50 == 7) std::this_thread::sleep_for(20ms);  // other parts overtake it
          ++progress;
          if (part >= wrong) {
            throw Error(ErrorCode::kInvalidInput, fmt::format("part {} is wrong", part));
          }
          return std::to_string(ranks.rank()) + ":" + result_of(part);
        },
        [&](std::size_t part, const std::string& bytes) {
          expect(part == next && part < wrong, "the next result");
          ++next;
          const auto colon = bytes.find(':');
          const auto rank = std::stoull(bytes.substr(0, colon));
          expect(!dealt || (part >= rank * count / size && part < (rank + 1) * count / size),
                 "dealt");
          expect(bytes.substr(colon + 1) == result_of(part), "what the part gave");
        });
  } catch (const Error& error) {
    expect(error.code() == ErrorCode::kInvalidInput, error.what());
    thrown = error.what();
  }
  const bool is_first = ranks.rank() == 0;
  expect(next == (is_first ? std::min(count, wrong) : 0), "all results are taken");
  expect(called == (is_first ? "a job of it" : ""), "rank 0 calls the others");
  expect(thrown == (is_first && wrong < count ? fmt::format("part {} is wrong", wrong) : ""),
         "what was thrown: " + thrown);
}

// A stage ends on all ranks at the same time.
void stages(Ranks& ranks) {
  RankExecutor executor(ranks, 2);
  const auto files = [&](std::size_t stage) {
    std::size_t n = 0;
    for (std::size_t part = 0; part < 20; ++part) {
      n += std::filesystem::exists(fmt::format("stage.{}.{}", stage, part)) ? 1 : 0;
    }
    return n;
  };
  for (std::size_t stage = 0; stage < 5; ++stage) {
    executor.run(
        {.count = 20, .wide = 20, .in_order = false},
        [&](std::size_t part, int) {
          ++progress;
          expect(stage == 0 || files(stage - 1) == 0, "what once() did");
          std::ofstream(fmt::format("stage.{}.{}", stage, part)) << "done";
          return std::string();
        },
        [](std::size_t, const std::string&) {});
    expect(files(stage) == 20, "all files of the stage");
    executor.once([&] {
      expect(ranks.rank() == 0, "on rank 0");
      for (std::size_t part = 0; part < 20; ++part) {
        std::filesystem::remove(fmt::format("stage.{}.{}", stage, part));
      }
    });
  }
}

void nothing(std::size_t) {}

// Makes progress until the rank is told to stop.
void until_stopped() {
  while (stop_signal == 0) {
    ++progress;
    std::this_thread::sleep_for(1ms);
  }
}

// Other ranks see the file when it is complete. Tests search for files by the beginning of the
// name: the partial file has another beginning.
void write_whole(const std::string& name, const std::string& text) {
  const std::string part =
      fmt::format("part.{}.{}", std::hash<std::thread::id>()(std::this_thread::get_id()), name);
  std::ofstream(part) << text;
  std::filesystem::rename(part, name);
}

void run_case(Ranks& ranks, const std::string& name, int chosen) {
  const auto is_chosen = [&](const Ranks& here) { return here.rank() == chosen; };
  // On a busy machine the other ranks would take all parts before the chosen rank asks for one.
  // From some part on they wait for it.
  const auto wait_for_chosen = [&](const Ranks& here, std::size_t part) {
    while (!is_chosen(here) && part > 20 && !std::filesystem::exists("met")) {
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
  } else if (name == "parts") {
    for (int round = 0; round < 3; ++round) {
      parts(
          ranks, [](Ranks&, std::size_t) {}, nothing);
    }
  } else if (name == "ordered") {
    for (const bool dealt : {false, true}) {
      for (const std::size_t wrong : {kParts, kParts / 3, std::size_t{0}}) {
        ordered(ranks, dealt, kParts, wrong);
      }
      for (const std::size_t few : {0, 1}) ordered(ranks, dealt, few, kParts);
    }
  } else if (name == "stages") {
    stages(ranks);
  } else if (name == "throws") {  // while other ranks have parts
    std::atomic<int> n = 0;
    const Work work = [&](const Ranks& here, std::size_t part) {
      wait_for_chosen(here, part);
      if (is_chosen(here) && ++n == 3) {
        write_whole("met", {});
        throw Error(ErrorCode::kNotStarShaped, "a bad file");
      }
      std::this_thread::sleep_for(1ms);
    };
    parts(ranks, work, nothing);
  } else if (name == "throws-at-once") {  // all ranks, each with another error
    throw Error(ErrorCode::kInvalidInput, fmt::format("bad file {}", ranks.rank()));
  } else if (name == "does-not-take") {
    const Work slow = [](Ranks&, std::size_t part) {
      if (part > 20) until_stopped();
    };
    parts(ranks, slow, [](std::size_t part) {
      if (part == 20) throw Error(ErrorCode::kIo, "the disk is full");
    });
  } else if (name == "stuck") {  // the rank is alive, but its part does not end
    ranks.set_patience(3);
    const Work work = [&](const Ranks& here, std::size_t part) {
      wait_for_chosen(here, part);
      if (!is_chosen(here)) return;
      write_whole("met", {});
      while (true) std::this_thread::sleep_for(10ms);
    };
    parts(ranks, work, nothing);
  } else if (name == "slow") {  // until it is told to stop
    const Work work = [](const Ranks& here, std::uint64_t) {
      write_whole(fmt::format("works.{}", here.rank()), std::to_string(getpid()));
      until_stopped();
    };
    ranks.set_patience(5);
    parts(ranks, work, nothing);
  } else if (name == "leaves") {  // the others wait for rank 0
    if (ranks.rank() != 0) ranks.receive(Tag::kTest);
  } else {
    throw Error(ErrorCode::kUnsupported, "no such case: " + name);
  }
}

Ending ending_of(const std::exception_ptr& what) {
  try {
    std::rethrow_exception(what);
  } catch (const Error& error) {
    const bool is_of_input =
        error.code() == ErrorCode::kInvalidInput || error.code() == ErrorCode::kNotStarShaped;
    return {is_of_input ? 3 : 1, error.what()};
  } catch (const std::exception& error) {
    return {1, error.what()};
  }
}

// Runs all cases in one run; every case except the last ends with a barrier.
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
               .keep_going = {},
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
