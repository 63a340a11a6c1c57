#include <string>

#include "io/file/bytes.h"
#include "model/file/model_read.h"
#include "reconstruct/file/model_file.h"
#include "rholm/model.h"

namespace rholm {

CoefficientsFile read_any_coefficients(const std::filesystem::path& path,
                                       const CoefficientsReadOptions& options,
                                       const Context& context) {
  const Bytes bytes = read_bytes(path, context);
  const std::string name = path == "-" ? "standard input" : path.string();
  if (!looks_like_model(bytes.view())) return parse_coefficients(bytes.view(), name, options);
  CoefficientsFile file;
  file.expansion = parse_model(bytes.view(), name);
  file.convention = {Normalization::kOrthonormal, 1};
  return file;
}

}  // namespace rholm
