// Numbered tasks that other processes do, too. Layer: base, private.
//
// What a task gives does not depend on who does it, so what is made of all of them, in their order,
// does not depend on how many processes there are.
#pragma once

#include <cstddef>
#include <functional>
#include <string>

namespace rholm {

struct SharedTasks {
  std::string job;        // what another process needs to do them
  std::size_t count = 0;  // of tasks
  // Each process gets tasks that follow each other, as many as the others, and the same ones of
  // every list of that length. Else whoever is free gets the next one.
  bool dealt = false;
};
// Does one of them; called by several threads at a time.
using DoSharedTask = std::function<std::string(std::size_t task)>;
// Takes what they gave, in the order of the tasks; called by the thread that shares them.
using TakeSharedResult = std::function<void(std::size_t task, const std::string& bytes)>;

// Has all of them done, by `here` in this process; returns when all results are taken. Throws what
// these throw, and what ends the other processes.
using ShareTasks = std::function<void(const SharedTasks& tasks, const DoSharedTask& here,
                                      const TakeSharedResult& take)>;

}  // namespace rholm
