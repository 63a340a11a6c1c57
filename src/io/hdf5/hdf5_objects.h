// Reads from memory the parts of HDF5 that locate the objects of a model file: superblock, object
// headers and groups. hdf5_values.h reads values. Layer: io, private.
//
// The HDF5 library may write models but does not read them. On damaged or malicious files it reads
// outside its buffers and loops. This was seen with 1.10.8, mostly in the global heap of strings
// and in older metadata without checksums. Here every access is checked against the file, and
// memory is limited by the size of the file.
//
// Source: HDF5 File Format Specification, version 3.0. Supported are superblocks 0 to 3; object
// headers 1 and 2; groups as symbol tables or compact links; compact attributes; contiguous and
// compact datasets; integers, IEEE numbers and strings. The library and h5py write these by default
// for plain arrays. Everything else throws Unsupported: compression, chunks, links to other places,
// "dense" storage of many attributes or links.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "io/hdf5/hdf5_bytes.h"

namespace rholm::hdf5 {

// Checks the superblock and the file's length against it. Throws InvalidInput, Unsupported.
File open(std::string_view bytes, const std::string& name);
bool has_signature(std::string_view bytes);

// A group or dataset: the messages of its object header.
struct Message {
  unsigned type = 0;
  std::string_view data;
};
struct Object {
  std::string path;  // for messages
  std::vector<Message> messages;
};
Object root_group(const File& file);
bool has_member(const File& file, const Object& group, std::string_view name);
// Throws InvalidInput if the group has no such member, Unsupported if the member is a soft or
// external link.
Object open_member(const File& file, const Object& group, std::string_view name);

}  // namespace rholm::hdf5
