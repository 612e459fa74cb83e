PRAGMA user_version=1;
BEGIN TRANSACTION;
CREATE TABLE job_events (
	job_id VARCHAR(36) NOT NULL, 
	sequence INTEGER NOT NULL, 
	at DATETIME NOT NULL, 
	kind VARCHAR(32) NOT NULL, 
	phase VARCHAR(16) NOT NULL, 
	message VARCHAR(500) NOT NULL, 
	data JSON NOT NULL, 
	PRIMARY KEY (job_id, sequence), 
	FOREIGN KEY(job_id) REFERENCES jobs (id)
);
INSERT INTO "job_events" VALUES('01a201a5-10af-7403-b9ae-6931dd6f9789',1,'2026-11-22 05:05:44.427139','phase_started','preflight','Checking the robot and the charging station.','{}');
INSERT INTO "job_events" VALUES('01a201a5-10af-7403-b9ae-6931dd6f9789',2,'2026-11-22 05:05:44.547139','phase_started','locating','Looking for the label beside the socket.','{}');
INSERT INTO "job_events" VALUES('01a201a5-10af-7403-b9ae-6931dd6f9789',3,'2026-11-22 05:05:44.628476','label_found','locating','Found the label.','{"x_mm": 664.6, "y_mm": 369.96, "z_mm": 230.56, "lateral_sigma_mm": 0.0031, "tilt_deg": 1.06}');
INSERT INTO "job_events" VALUES('01a201a5-10af-7403-b9ae-6931dd6f9789',4,'2026-11-22 05:05:44.628476','phase_started','aligning','Moving the plug in front of the socket.','{}');
INSERT INTO "job_events" VALUES('01a201a5-10af-7403-b9ae-6931dd6f9789',5,'2026-11-22 05:05:46.595142','measured','aligning','Measured the socket standing still.','{"lateral_sigma_mm": 0.0239}');
INSERT INTO "job_events" VALUES('01a201a5-10af-7403-b9ae-6931dd6f9789',6,'2026-11-22 05:05:46.862958','phase_started','inserting','Pushing the plug in.','{}');
INSERT INTO "job_events" VALUES('01a201a5-10af-7403-b9ae-6931dd6f9789',7,'2026-11-22 05:05:51.513981','seated','inserting','The plug is 40.0 mm deep.','{"insertion_depth_mm": 39.995, "lateral_error_mm": 0.0, "max_force_n": 70.7, "plugged_after_s": 7.087, "limit_duration_s": 5.966}');
INSERT INTO "job_events" VALUES('01a201a5-10af-7403-b9ae-6931dd6f9789',8,'2026-11-22 05:05:51.513981','phase_started','plugged','The plug is in. Asking the charging station.','{}');
INSERT INTO "job_events" VALUES('01a201a5-10af-7403-b9ae-6931dd6f9789',9,'2026-11-22 05:05:51.573981','connected','plugged','The charging station sees the car.','{}');
INSERT INTO "job_events" VALUES('01a201a5-10af-7403-b9ae-6931dd6f9789',10,'2026-11-22 05:05:51.573981','phase_started','charging','Charging.','{}');
INSERT INTO "job_events" VALUES('01a201a5-10af-7403-b9ae-6931dd6f9789',11,'2026-11-22 05:08:20.093981','charging_done','charging','The car has got its 0.3 kWh.','{}');
INSERT INTO "job_events" VALUES('01a201a5-10af-7403-b9ae-6931dd6f9789',12,'2026-11-22 05:08:20.093981','phase_started','releasing','Ending the charging and unlocking the plug.','{}');
INSERT INTO "job_events" VALUES('01a201a5-10af-7403-b9ae-6931dd6f9789',13,'2026-11-22 05:08:21.883981','released','releasing','No current flows, and the plug is unlocked.','{"energy_wh": 300.3}');
INSERT INTO "job_events" VALUES('01a201a5-10af-7403-b9ae-6931dd6f9789',14,'2026-11-22 05:08:21.883981','phase_started','withdrawing','Pulling the plug out.','{}');
INSERT INTO "job_events" VALUES('01a201a5-10af-7403-b9ae-6931dd6f9789',15,'2026-11-22 05:08:26.597890','withdrawn','withdrawing','The plug is out.','{"max_pull_n": 67.7}');
INSERT INTO "job_events" VALUES('01a201a5-10af-7403-b9ae-6931dd6f9789',16,'2026-11-22 05:08:26.597890','phase_started','parking','Going back to the parking place.','{}');
INSERT INTO "job_events" VALUES('01a201a5-10af-7403-b9ae-6931dd6f9789',17,'2026-11-22 05:08:29.359838','succeeded','parking','Done.','{}');
INSERT INTO "job_events" VALUES('01a201a5-168c-7fb0-a85b-81c28c7f0a2c',1,'2026-11-22 05:08:29.359838','phase_started','preflight','Checking the robot and the charging station.','{}');
INSERT INTO "job_events" VALUES('01a201a5-168c-7fb0-a85b-81c28c7f0a2c',2,'2026-11-22 05:08:29.479838','phase_started','locating','Looking for the label beside the socket.','{}');
INSERT INTO "job_events" VALUES('01a201a5-168c-7fb0-a85b-81c28c7f0a2c',3,'2026-11-22 05:08:29.561809','label_found','locating','Found the label.','{"x_mm": 664.6, "y_mm": 369.96, "z_mm": 230.59, "lateral_sigma_mm": 0.0032, "tilt_deg": 1.07}');
INSERT INTO "job_events" VALUES('01a201a5-168c-7fb0-a85b-81c28c7f0a2c',4,'2026-11-22 05:08:29.561809','phase_started','aligning','Moving the plug in front of the socket.','{}');
INSERT INTO "job_events" VALUES('01a201a5-168c-7fb0-a85b-81c28c7f0a2c',5,'2026-11-22 05:08:29.569838','cancel_requested','aligning','Somebody asked to cancel.','{}');
INSERT INTO "job_events" VALUES('01a201a5-168c-7fb0-a85b-81c28c7f0a2c',6,'2026-11-22 05:08:29.662743','phase_started','parking','Going back to the parking place.','{}');
INSERT INTO "job_events" VALUES('01a201a5-168c-7fb0-a85b-81c28c7f0a2c',7,'2026-11-22 05:08:29.860569','cancelled','parking','Cancelled; the robot is back in its parking place.','{}');
INSERT INTO "job_events" VALUES('01a201a5-16d5-748a-b774-3ba99575df59',1,'2026-11-22 05:08:29.860569','phase_started','preflight','Checking the robot and the charging station.','{}');
INSERT INTO "job_events" VALUES('01a201a5-16d5-748a-b774-3ba99575df59',2,'2026-11-22 05:08:29.980569','phase_started','locating','Looking for the label beside the socket.','{}');
INSERT INTO "job_events" VALUES('01a201a5-16d5-748a-b774-3ba99575df59',3,'2026-11-22 05:08:30.061809','label_found','locating','Found the label.','{"x_mm": 664.6, "y_mm": 369.96, "z_mm": 230.57, "lateral_sigma_mm": 0.003, "tilt_deg": 1.06}');
INSERT INTO "job_events" VALUES('01a201a5-16d5-748a-b774-3ba99575df59',4,'2026-11-22 05:08:30.061809','phase_started','aligning','Moving the plug in front of the socket.','{}');
INSERT INTO "job_events" VALUES('01a201a5-16d5-748a-b774-3ba99575df59',5,'2026-11-22 05:08:32.028476','measured','aligning','Measured the socket standing still.','{"lateral_sigma_mm": 0.0239}');
INSERT INTO "job_events" VALUES('01a201a5-16d5-748a-b774-3ba99575df59',6,'2026-11-22 05:08:32.237768','phase_started','inserting','Pushing the plug in.','{}');
INSERT INTO "job_events" VALUES('01a201a5-16d5-748a-b774-3ba99575df59',7,'2026-11-22 05:08:36.886115','seated','inserting','The plug is 40.0 mm deep.','{"insertion_depth_mm": 40.003, "lateral_error_mm": 0.0, "max_force_n": 70.2, "plugged_after_s": 7.026, "limit_duration_s": 5.966}');
INSERT INTO "job_events" VALUES('01a201a5-16d5-748a-b774-3ba99575df59',8,'2026-11-22 05:08:36.886115','phase_started','plugged','The plug is in. Asking the charging station.','{}');
INSERT INTO "job_events" VALUES('01a201a5-16d5-748a-b774-3ba99575df59',9,'2026-11-22 05:08:36.946115','connected','plugged','The charging station sees the car.','{}');
INSERT INTO "job_events" VALUES('01a201a5-16d5-748a-b774-3ba99575df59',10,'2026-11-22 05:08:36.946115','phase_started','charging','Charging.','{}');
CREATE TABLE jobs (
	id VARCHAR(36) NOT NULL, 
	type VARCHAR(16) NOT NULL, 
	state VARCHAR(16) NOT NULL, 
	phase VARCHAR(16) NOT NULL, 
	vehicle_id VARCHAR(64) NOT NULL, 
	target_energy_wh FLOAT, 
	created_at DATETIME NOT NULL, 
	updated_at DATETIME NOT NULL, 
	phase_started_at DATETIME NOT NULL, 
	cancel_requested BOOLEAN NOT NULL, 
	result JSON NOT NULL, 
	error JSON, 
	idempotency_key VARCHAR(255), 
	request_digest VARCHAR(64), 
	PRIMARY KEY (id), 
	UNIQUE (idempotency_key)
);
INSERT INTO "jobs" VALUES('01a201a5-10af-7403-b9ae-6931dd6f9789','charge','succeeded','parking','demo',300.0,'2026-11-22 05:05:44.427139','2026-11-22 05:08:29.359838','2026-11-22 05:08:26.597890',0,'{"insertion_depth_mm": 39.995, "lateral_error_mm": 0.0, "lateral_sigma_mm": 0.0239, "max_force_n": 70.7, "energy_wh": 300.3, "plugged_after_s": 7.087, "limit_duration_s": 5.966}',NULL,'key-1','0000000000000000000000000000000000000000000000000000000000000000');
INSERT INTO "jobs" VALUES('01a201a5-168c-7fb0-a85b-81c28c7f0a2c','plug_in','cancelled','parking','demo',NULL,'2026-11-22 05:08:29.359838','2026-11-22 05:08:29.860569','2026-11-22 05:08:29.662743',1,'{"insertion_depth_mm": null, "lateral_error_mm": null, "lateral_sigma_mm": null, "max_force_n": null, "energy_wh": null, "plugged_after_s": null, "limit_duration_s": null}',NULL,NULL,NULL);
INSERT INTO "jobs" VALUES('01a201a5-16d5-748a-b774-3ba99575df59','charge','running','charging','demo',NULL,'2026-11-22 05:08:29.860569','2026-11-22 05:08:36.946115','2026-11-22 05:08:36.946115',0,'{"insertion_depth_mm": 40.003, "lateral_error_mm": 0.0, "lateral_sigma_mm": 0.0239, "max_force_n": 70.2, "energy_wh": null, "plugged_after_s": 7.026, "limit_duration_s": 5.966}',NULL,'key-2','1111111111111111111111111111111111111111111111111111111111111111');
CREATE TABLE plug (
	id INTEGER NOT NULL, 
	state VARCHAR(16) NOT NULL, 
	corridor JSON, 
	PRIMARY KEY (id)
);
INSERT INTO "plug" VALUES(1,'inserted','{"rho1_mm": 241.59447265575676, "rho2_mm": 212.3421982108243, "clear_rho3_mm": 61.83565475583572, "face_rho3_mm": 81.83565475583572, "depth_rho3_mm": 121.83565475583572}');
CREATE TABLE vehicles (
	id VARCHAR(64) NOT NULL, 
	settings JSON NOT NULL, 
	PRIMARY KEY (id)
);
INSERT INTO "vehicles" VALUES('demo','{"name": "Demo car", "label_size_mm": 60.0, "socket": {"x_mm": 119.13579738264083, "y_mm": -0.5887493086596947, "z_mm": -0.5556474613946046, "rotation_x_rad": -0.007777666599219629, "rotation_y_rad": 0.004593186517623787}}');
INSERT INTO "vehicles" VALUES('zoe','{"name": "Zo\u00e9 of Anna", "label_size_mm": 60.0, "socket": {"x_mm": 120.0, "y_mm": -3.5, "z_mm": 1.0, "rotation_x_rad": 0.01, "rotation_y_rad": 0.0}}');
CREATE INDEX jobs_by_state ON jobs (state);
COMMIT;
