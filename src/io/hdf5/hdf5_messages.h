// The messages of HDF5's object headers that are used. Layer: io, private.
#pragma once

namespace rholm::hdf5 {

inline constexpr unsigned kDataspaceMessage = 0x01;
inline constexpr unsigned kLinkInfoMessage = 0x02;
inline constexpr unsigned kDatatypeMessage = 0x03;
inline constexpr unsigned kLinkMessage = 0x06;
inline constexpr unsigned kExternalFilesMessage = 0x07;
inline constexpr unsigned kLayoutMessage = 0x08;
inline constexpr unsigned kFilterMessage = 0x0b;
inline constexpr unsigned kAttributeMessage = 0x0c;
inline constexpr unsigned kContinuationMessage = 0x10;
inline constexpr unsigned kSymbolTableMessage = 0x11;
inline constexpr unsigned kAttributeInfoMessage = 0x15;

constexpr bool is_used(unsigned type) {
  return type == kDataspaceMessage || type == kLinkInfoMessage || type == kDatatypeMessage ||
         type == kLinkMessage || type == kLayoutMessage || type == kAttributeMessage ||
         type == kSymbolTableMessage;
}

}  // namespace rholm::hdf5
