"""What rerun's SDK keeps of a stream that has ended, given back: two threads and some memory of each.

`send_blueprint` of the SDK leaves a stream whose sink refers to the stream itself, and streams without a Python object
are only swept when another one is dropped. rerun is pinned to one minor version, and this relies on its bindings.
"""

from __future__ import annotations

import rerun as rr
import rerun.blueprint as rrb
import rerun_bindings as bindings


def send_blueprint(stream: rr.RecordingStream, blueprint: rrb.Blueprint) -> None:
    """Same as `stream.send_blueprint`, but nothing is left of the stream in which the blueprint is made."""
    name = rr.get_application_id(stream)
    assert name is not None
    made = rr.RecordingStream._from_native(
        bindings.new_blueprint(application_id=name, make_default=False, make_thread_default=False, default_enabled=True)
    )
    made.set_time("blueprint", sequence=0)
    blueprint._log_to_stream(made)
    kept = made.memory_recording()
    bindings.send_blueprint(kept.storage, True, True, recording=stream.to_native())
    made.disconnect()


def sweep() -> None:
    """End the threads of streams that are gone."""
    bindings.flush_and_cleanup_orphaned_recordings()
