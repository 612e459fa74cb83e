"""kill -9 at random instants over whole jobs: a real server, and a garage that outlives it.

The garage is in the process of the campaign: motors, car, socket, station and motion board go on
whatever becomes of the server. The server is the real one, a process with its own database; only
its drivers are replaced by the far end of a wire. Both share one time: the garage goes on to the
time of the server, five milliseconds of the simulation at a time, and on its own once the server is
dead. So a busy machine makes the campaign slower, and changes nothing else.
"""
