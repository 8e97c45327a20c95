"""The exceptions of dsc, one class per family of errors."""


class Error(Exception):
    """Base of all errors of dsc.

    Attributes: `code`, a stable name such as "io.truncated" (share/doc/errors.md lists all); `place`, a file with its line, an
    argument or a strategy, may be empty; `cause`; `remedy`, may be empty; `exit_code`, that of the command `dsc`.
    """

    def __init__(self, message, code="", place="", cause="", remedy="", exit_code=1):
        super().__init__(message)
        self.code = code
        self.place = place
        self.cause = cause or message
        self.remedy = remedy
        self.exit_code = exit_code


class UsageError(Error):
    """A wrong call, such as an array of a wrong shape."""


class ConfigError(Error):
    """A wrong experiment."""


class PluginError(Error):
    """A plugin that does not load or does not fit."""


class StrategyError(Error):
    """A strategy that raised an exception or returned a wrong answer."""


class GeometryError(Error):
    """Geometry or numbers that cannot be used."""


class IoError(Error):
    """A file that cannot be read or written."""


class CancelledError(Error):
    """The run was stopped before there was a result."""


def usage_error(code, place, cause, remedy):
    """A UsageError with its message."""
    return UsageError(f"{place}: {cause}; {remedy}", code, place, cause, remedy, 2)
