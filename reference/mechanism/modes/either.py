"""A mechanism generated from a scene, in the plane or in space, and what holds in all its modes."""

from .mechanism import Mechanism
from .mode import Multibody
from .spatial_mechanism import SpatialMechanism
from .spatial_mode import SpatialMultibody

Generated = Mechanism | SpatialMechanism
Base = Multibody | SpatialMultibody
