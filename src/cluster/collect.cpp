#include "cluster/collect.h"

#include <algorithm>

#include <fmt/format.h>

#include "base/bytes.h"
#include "base/refuse.h"

namespace rholm {
namespace {

// Sends bytes along a binomial tree. Rank r receives them from r without its lowest bit, and sends
// them to r + 2^k for all 2^k below that bit.
std::string spread(Ranks& ranks, std::string bytes, Tag tag) {
  const int rank = ranks.rank(), size = ranks.size();
  if (rank != 0) bytes = ranks.receive(tag, rank & (rank - 1)).bytes;
  int bit = 1;
  while (bit < size && (rank & bit) == 0) bit <<= 1;
  for (bit >>= 1; bit > 0; bit >>= 1) {
    if (rank + bit < size) ranks.send(rank + bit, tag, bytes);
  }
  return bytes;
}

}  // namespace

std::string broadcast(Ranks& ranks, std::string bytes) {
  return spread(ranks, std::move(bytes), Tag::kCollect);
}

std::vector<std::string> gather(Ranks& ranks, std::string bytes) {
  if (ranks.rank() != 0) {
    ranks.send(0, Tag::kCollect, std::move(bytes));
    return {};
  }
  std::vector<std::string> all(static_cast<std::size_t>(ranks.size()));
  all[0] = std::move(bytes);
  for (int i = 1; i < ranks.size(); ++i) {
    all[static_cast<std::size_t>(i)] = ranks.receive(Tag::kCollect, i).bytes;
  }
  return all;
}

void barrier(Ranks& ranks) {
  gather(ranks, {});
  broadcast(ranks, {});
}

void call(Ranks& ranks, const std::string& name, const std::string& bytes) {
  spread(ranks, ByteWriter().text(name).text(bytes).take(), Tag::kCall);
}

void serve_calls(Ranks& ranks, const Services& services) {
  for (;;) {
    const std::string bytes = spread(ranks, {}, Tag::kCall);
    ByteReader message(bytes);
    const std::string_view name = message.text();
    const auto found = std::find_if(services.begin(), services.end(),
                                    [&](const auto& service) { return service.first == name; });
    if (found == services.end())
      refuse(fmt::format("rank 0 calls for '{}', which is not known", name));
    found->second(ranks, std::string(message.text()));
  }
}

}  // namespace rholm
