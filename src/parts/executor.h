// Work in parts, and who does it. Layer: parts, private.
//
// What a part gives does not depend on who works it. So what is made of all parts, in their order,
// has the same bits for any number of threads and processes.
#pragma once

#include <cstddef>
#include <functional>
#include <string>

namespace rholm {

struct Parts {
  std::size_t count = 0;
  // The first parts, which are worked one at a time, each on all threads of a process. The others
  // have one thread each.
  std::size_t wide = 0;
  // Results are taken in the order of the parts, and only a few parts are begun ahead of them; else
  // as they come.
  bool in_order = true;
  // Each process works parts that follow each other, the same ones whenever `count` is the same.
  // Else whoever is free gets the next part.
  bool dealt = false;
  // What another process needs to work them: the name of the work, and its input.
  std::string job = {}, input = {};
};

class Executor {
 public:
  // Works a part on so many threads; called by several threads at a time. Gives bytes, as another
  // process may have to send them.
  using Work = std::function<std::string(std::size_t part, int threads)>;
  // Takes what a part gave; called by the thread that calls run().
  using Take = std::function<void(std::size_t part, std::string bytes)>;

  Executor() = default;
  virtual ~Executor() = default;
  Executor(const Executor&) = delete;
  Executor& operator=(const Executor&) = delete;

  // Has each part worked once, and returns when all results are taken. Throws the first exception
  // of `work` or `take`, once no part is worked any more, and Cancelled as the CancelScope of this
  // thread says, which is also asked while others work.
  virtual void run(const Parts& parts, const Work& work, const Take& take) = 0;
  // Calls the body in the process that takes results, while no part is worked.
  virtual void once(const std::function<void()>& body) = 0;
  // Whether other processes work parts.
  virtual bool is_shared() const = 0;
};

}  // namespace rholm
