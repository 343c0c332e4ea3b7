"""The states of all bodies in one call."""

from collections.abc import Callable
from functools import partial

from pymunk import batch
from pymunk.batch import BodyFields, Buffer, get_space_bodies
from pymunk.space import Space


def copier(space: Space, fields: BodyFields, buffer: Buffer) -> Callable[[], None]:
    """A function that copies the fields of all bodies behind what the buffer holds.

    `get_space_bodies` prepares the same call of Chipmunk's anew each time, which costs more than
    the copies and a step; should pymunk's inside be another one day, it serves.
    """
    try:
        data = batch.ffi.new("pmBatchedData *")
        data.fields = fields.value
        data.floatArray, data.intArray = buffer._float_arr, buffer._int_arr
        each = batch.ffi.addressof(batch.lib, "pmSpaceBodyGetIteratorFuncBatched")
        return partial(batch.lib.cpSpaceEachBody, space._space, each, data)
    except Exception:  # of many kinds: cffi raises its own
        return partial(get_space_bodies, space, fields, buffer)
