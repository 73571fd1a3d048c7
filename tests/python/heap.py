# SPDX-License-Identifier: MIT
"""What the C library's heap holds."""
import ctypes
import gc


class Mallinfo2(ctypes.Structure):
    _fields_ = [(name, ctypes.c_size_t) for name in (
        "arena", "ordblks", "smblks", "hblks", "hblkhd", "usmblks", "fsmblks", "uordblks", "fordblks", "keepcost")]


def bytes_in_use():
    """What malloc has given out and not got back."""
    ask = ctypes.CDLL(None).mallinfo2
    ask.restype = Mallinfo2
    gc.collect()
    now = ask()
    return now.uordblks + now.hblkhd
