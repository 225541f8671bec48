"""Types of what `import mahovik` offers; the module itself loads each name when it is first asked for."""

from mahovik.errors import InputError as InputError
from mahovik.errors import MahovikError as MahovikError
from mahovik.errors import RefusedError as RefusedError
from mahovik.errors import StandError as StandError
from mahovik.errors import StateError as StateError
from mahovik.errors import ToolchainError as ToolchainError
from mahovik.errors import UsageError as UsageError
from mahovik.out.api.calls import Status as Status
from mahovik.out.api.calls import status_words as status_words
from mahovik.out.api.model import Model as Model
from mahovik.out.api.model import build as build
from mahovik.out.api.stands import Stand as Stand
from mahovik.out.api.stands import example as example
from mahovik.out.api.stands import examples as examples
from mahovik.out.api.stands import load as load
from mahovik.out.api.states import States as States
from mahovik.out.commands.balance import balance as balance
from mahovik.out.commands.campaign import campaign as campaign
from mahovik.out.commands.check import check as check
from mahovik.out.commands.eval import eval as eval
from mahovik.out.commands.evidence import evidence as evidence
from mahovik.out.commands.generate import generate as generate
from mahovik.out.commands.identify import identify as identify
from mahovik.out.commands.judge import judge as judge
from mahovik.out.commands.modes import modes as modes
from mahovik.out.commands.new import new as new
from mahovik.out.commands.plan import plan as plan
from mahovik.out.commands.replay import replay as replay
from mahovik.out.commands.report import report as report
from mahovik.out.commands.simulate import simulate as simulate
from mahovik.out.commands.verify import verify as verify
from mahovik.out.commands.vibration import vibration as vibration
from mahovik.out.notices import MahovikWarning as MahovikWarning
from mahovik.out.notices import Progress as Progress
from mahovik.out.result import Result as Result

__version__: str
