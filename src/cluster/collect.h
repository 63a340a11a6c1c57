// All ranks at once: bytes to all, bytes of all. Layer: cluster, private.
//
// Every rank calls the same functions in the same order, from one thread each. All throw Stopped.
#pragma once

#include <string>
#include <vector>

#include "cluster/ranks.h"

namespace rholm {

// What rank 0 gives, on every rank: by a tree, so that rank 0 sends log2(ranks) times.
std::string broadcast(Ranks& ranks, std::string bytes);
// What each rank gives, in their order, on rank 0; nothing on the others.
std::vector<std::string> gather(Ranks& ranks, std::string bytes);
// Returns once all have called it.
void barrier(Ranks& ranks);

// On rank 0: has serve_calls() of all others call what has that name.
void call(Ranks& ranks, const std::string& name, const std::string& bytes);

// What other ranks can be called for, by name. Throws what it does not know how to do.
using Services = std::vector<
    std::pair<std::string, std::function<void(Ranks& ranks, const std::string& bytes)>>>;
// On other ranks: does what rank 0 calls for, until Stopped.
[[noreturn]] void serve_calls(Ranks& ranks, const Services& services);

}  // namespace rholm
