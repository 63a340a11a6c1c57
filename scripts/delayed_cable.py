"""A cable between two network namespaces that delays packets, for scripts/ranks-apart.

Usage: scripts/delayed_cable.py NAMESPACE NAMESPACE MILLISECONDS Each namespace gets a device `cable` of the
kind tun. Packets sent into one device leave the other after the delay.
"""

import collections
import ctypes
import fcntl
import os
import select
import struct
import sys
import time

TUNSETIFF = 0x400454CA
IFF_TUN, IFF_NO_PI = 0x0001, 0x1000
CLONE_NEWNET = 0x40000000


def device(namespace):
    """Returns the descriptor of a new device in that namespace."""
    with open(f"/var/run/netns/{namespace}") as handle:
        if ctypes.CDLL(None, use_errno=True).setns(handle.fileno(), CLONE_NEWNET) != 0:
            raise OSError(ctypes.get_errno(), f"namespace {namespace}")
    descriptor = os.open("/dev/net/tun", os.O_RDWR | os.O_NONBLOCK)
    fcntl.ioctl(descriptor, TUNSETIFF, struct.pack("16sH22x", b"cable", IFF_TUN | IFF_NO_PI))
    return descriptor


def main():
    ends = [device(name) for name in sys.argv[1:3]]
    delay = float(sys.argv[3]) / 1000
    waiting = collections.deque()  # (time, target, packet) sorted by time: the delay is constant
    while True:
        left = max(0.0, waiting[0][0] - time.monotonic()) if waiting else None
        for end in select.select(ends, [], [], left)[0]:
            try:
                packet = os.read(end, 65536)
            except OSError:  # the device is not up yet
                continue
            waiting.append((time.monotonic() + delay, ends[1 - ends.index(end)], packet))
        while waiting and waiting[0][0] <= time.monotonic():
            try:
                os.write(waiting[0][1], waiting[0][2])
            except OSError:
                pass  # the packet is lost
            waiting.popleft()


if __name__ == "__main__":
    main()
