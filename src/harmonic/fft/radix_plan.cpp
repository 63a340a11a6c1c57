#include <map>
#include <mutex>
#include <variant>

#include "harmonic/fft/chirp_plan.h"
#include "harmonic/fft/complex_plan.h"
#include "harmonic/fft/radix_passes.h"

namespace rholm {
namespace {

template <typename T>
using Plan = std::variant<RadixPlan<T>, ChirpPlan<T>>;

template <typename T>
Plan<T> make_plan(std::size_t n) {
  if (is_radix_length(n)) return make_radix_plan<T>(n);
  return make_chirp_plan<T>(n);
}

template <typename T>
void execute(const void* plan, std::complex<T>* in, std::complex<T>* out) {
  const auto& made = *static_cast<const Plan<T>*>(plan);
  if (const auto* radix = std::get_if<RadixPlan<T>>(&made)) {
    run_radix_plan(*radix, in, out);
  } else {
    run_chirp_plan(std::get<ChirpPlan<T>>(made), in, out);
  }
}

}  // namespace

template <typename T>
const void* complex_plan(std::size_t n) {
  static std::mutex mutex;
  static auto& plans = *new std::map<std::size_t, Plan<T>>;  // never destroyed
  const std::lock_guard lock(mutex);
  auto found = plans.find(n);
  if (found == plans.end()) found = plans.emplace(n, make_plan<T>(n)).first;
  return &found->second;
}

void execute_plan(const void* plan, std::complex<float>* in, std::complex<float>* out) {
  execute(plan, in, out);
}
void execute_plan(const void* plan, std::complex<double>* in, std::complex<double>* out) {
  execute(plan, in, out);
}

template const void* complex_plan<float>(std::size_t);
template const void* complex_plan<double>(std::size_t);

}  // namespace rholm
