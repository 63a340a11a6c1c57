// The studio: requests and events, which notebooks send as messages.
#include "rholm/studio.h"

#include <nanobind/stl/map.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/unique_ptr.h>

#include <chrono>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "bindings.h"
#include "caller.h"

namespace rholm::python {
namespace {

// Returns (status, type, body, download).
nb::tuple handle(Studio& studio, const std::string& method, const std::string& path,
                 const std::map<std::string, std::string>& query, const nb::bytes& body,
                 const std::string& session) {
  const StudioRequest request = {.method = method,
                                 .path = path,
                                 .query = query,
                                 .body = {body.c_str(), body.size()},
                                 .session = session};
  const StudioResponse answer = unlocked([&] { return studio.handle(request); });
  return nb::make_tuple(answer.status, answer.type,
                        nb::bytes(answer.body.data(), answer.body.size()), answer.download);
}

// Returns [(name, JSON), ...].
nb::list wait(StudioListener& listener, double seconds) {
  const auto time = std::chrono::milliseconds(static_cast<int>(1000 * seconds));
  std::vector<StudioEvent> events;
  {
    const nb::gil_scoped_release released;
    events = listener.wait(time);
  }
  nb::list told;
  for (const StudioEvent& event : events) told.append(nb::make_tuple(event.name, event.data));
  return told;
}

}  // namespace

void bind_studio(nb::module_& m) {
  nb::class_<StudioListener>(m, "StudioListener", "Who listens to a session.")
      .def("wait", &wait, nb::arg("seconds"))
      .def_prop_ro("ended", &StudioListener::ended);
  nb::class_<Studio>(m, "Studio", "Requests in, responses out.")
      .def(
          "__init__",
          [](Studio* self, const std::string& folder, int threads) {
            new (self) Studio({.folder = folder, .threads = threads});
          },
          nb::arg("folder"), nb::arg("threads"))
      .def("handle", &handle, nb::arg("method"), nb::arg("path"), nb::arg("query"), nb::arg("body"),
           nb::arg("session"))
      .def("offered_session", &Studio::offered_session)
      .def(
          "listen",
          [](Studio& studio, const std::string& session) { return studio.listen(session); },
          nb::arg("session"), nb::keep_alive<0, 1>())
      .def("close", [](Studio& studio) {
        const nb::gil_scoped_release released;
        studio.close();
      });
}

}  // namespace rholm::python
