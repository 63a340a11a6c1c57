// Collective calls of all ranks: broadcast, gather, barrier. Layer: cluster, private.
//
// Every rank calls the same functions in the same order, from one thread each. All throw Stopped.
#pragma once

#include <string>
#include <vector>

#include "cluster/ranks.h"

namespace rholm {

// Returns rank 0's bytes on every rank, along a tree: rank 0 sends log2(ranks) times.
std::string broadcast(Ranks& ranks, std::string bytes);
// Returns the bytes of each rank, in the order of ranks, on rank 0; returns nothing on the others.
std::vector<std::string> gather(Ranks& ranks, std::string bytes);
// Returns once all ranks have called it.
void barrier(Ranks& ranks);

// Called on rank 0: makes serve_calls() of all other ranks call the service of that name.
void call(Ranks& ranks, const std::string& name, const std::string& bytes);

// The services of a rank, by name. serve_calls() throws InvalidInput for an unknown name.
using Services = std::vector<
    std::pair<std::string, std::function<void(Ranks& ranks, const std::string& bytes)>>>;
// Called on other ranks: runs the services that rank 0 calls, until it throws Stopped.
[[noreturn]] void serve_calls(Ranks& ranks, const Services& services);

}  // namespace rholm
