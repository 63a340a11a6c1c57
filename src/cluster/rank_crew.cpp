#include "cluster/rank_crew.h"

#include <cstdint>
#include <numeric>
#include <string>

#include "cluster/collect.h"
#include "cluster/tasks.h"

namespace rholm {

void RankCrew::each(std::size_t n, const Body& body, const Done& done) {
  const DoTask work = [&](std::uint64_t tile, int) {
    body(static_cast<std::size_t>(tile));
    return std::string();
  };
  if (ranks_.rank() == 0) {
    TaskList tasks;
    tasks.wide.resize(n);
    std::iota(tasks.wide.begin(), tasks.wide.end(), std::uint64_t{0});
    std::size_t n_done = 0;
    lead_tasks(ranks_, tasks, threads_, work,
               [&](std::uint64_t, const std::string&) { done(++n_done); });
  } else {
    serve_tasks(ranks_, threads_, work);
  }
  barrier(ranks_);
}

void RankCrew::once(const std::function<void()>& body) {
  barrier(ranks_);
  if (ranks_.rank() == 0) {
    const AtWork at_work(ranks_);
    body();
  }
  barrier(ranks_);
}

}  // namespace rholm
