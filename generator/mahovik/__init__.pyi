"""Types of what `import mahovik` offers; the module itself loads each name when it is first asked for."""

from mahovik.core.stand.model import Stand as Stand
from mahovik.errors import InputError as InputError
from mahovik.errors import MahovikError as MahovikError
from mahovik.errors import RefusedError as RefusedError
from mahovik.errors import StandError as StandError
from mahovik.errors import StateError as StateError
from mahovik.errors import ToolchainError as ToolchainError
from mahovik.errors import UsageError as UsageError
from mahovik.out.api.model import Model as Model
from mahovik.out.api.model import build as build
from mahovik.out.api.results import Result as Result
from mahovik.out.api.stands import example as example
from mahovik.out.api.stands import examples as examples
from mahovik.out.api.stands import load as load
from mahovik.out.api.states import States as States

__version__: str
