/* The C interface of the bus safety supervisor.
 *
 * SPDX-License-Identifier: MIT OR Apache-2.0
 *
 * How to use it stands in supervisor/capi/README.md. In short, all from one context:
 *
 *   static SupervisorState state;
 *   supervisor_init(&state, sizeof state, SUPERVISOR_ABI_VERSION, sealed, sealed_bytes, cause, record);
 *   for every frame read:  supervisor_receive(&state, now_ms, &frame, NULL);
 *   every 10 ms:           supervisor_step(&state, now_ms, &decision, frames, SUPERVISOR_OUTPUT_FRAMES, &count);
 *                          send frames[0] to frames[count - 1]; persist decision.status.record;
 *                          supervisor_watchdog(&state, question, answer);
 *
 * Every call says by its code whether it was carried out; see SupervisorCode. A call that is refused writes nothing
 * but a count of 0 and, for the watchdog, an answer that is wrong. There is no global variable, no allocation, no
 * floating point and no panic.
 */

#ifndef SUPERVISOR_H
#define SUPERVISOR_H

/* Made by cbindgen from supervisor/capi/src; do not edit. */

#include <stddef.h>
#include <stdint.h>

/* A code that is not looked at is an error in the making: the compiler says so, where it can. */
#if defined(__GNUC__) || defined(__clang__)
#define SUPERVISOR_MUST_USE __attribute__((warn_unused_result))
#else
#define SUPERVISOR_MUST_USE
#endif

// Stands for a `SupervisorRecord` that fails its CRC when it is read back. Never given by a step.
#define SUPERVISOR_RECORD_BROKEN 255

// Version of this header. A library of another version refuses to start.
#define SUPERVISOR_ABI_VERSION 2

// Length of a sealed configuration in bytes.
#define SUPERVISOR_SEALED_BYTES 708

// How many frames a step gives at most: so many must the buffer hold.
#define SUPERVISOR_OUTPUT_FRAMES 16

// How many channels there are.
#define SUPERVISOR_CHANNELS 12

// How many bytes answer the watchdog.
#define SUPERVISOR_ANSWER_BYTES 4

// How many events are kept.
#define SUPERVISOR_EVENTS 64

// How many trouble codes there are.
#define SUPERVISOR_TROUBLES 38

// Words of the state. The same on every target, and more than any needs today.
#define SUPERVISOR_STATE_WORDS 896

// Bytes of the state.
#define SUPERVISOR_STATE_BYTES (8 * SUPERVISOR_STATE_WORDS)

// Words of the diagnosis.
#define SUPERVISOR_DIAGNOSIS_WORDS 448

// Bytes of the diagnosis.
#define SUPERVISOR_DIAGNOSIS_BYTES (8 * SUPERVISOR_DIAGNOSIS_WORDS)

// Whether a call was carried out. 0 to 15: it was; from 16 on it was refused, and changed nothing.
enum SupervisorCode
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : uint32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
    // Carried out.
    SUPERVISOR_CODE_OK = 0,
    // Carried out, and the frame counts for nothing: the receipt says why. Nothing to do; the vetting knows.
    SUPERVISOR_CODE_FRAME_REFUSED = 1,
    // Carried out: there is nothing to give at this time.
    SUPERVISOR_CODE_NOTHING = 2,
    // A pointer is null.
    SUPERVISOR_CODE_NULL = 16,
    // A pointer does not have the alignment of what it points to.
    SUPERVISOR_CODE_MISALIGNED = 17,
    // Memory is smaller than what belongs there, or ends beyond the address space.
    SUPERVISOR_CODE_SIZE = 18,
    // The state (or diagnosis) was never initialised, its last initialisation was refused, or it was overwritten.
    SUPERVISOR_CODE_UNINITIALISED = 19,
    // Two arguments share memory.
    SUPERVISOR_CODE_OVERLAP = 20,
    // The header that the caller was compiled with is of another version than the library.
    SUPERVISOR_CODE_VERSION = 21,
    // An argument is no code of its table.
    SUPERVISOR_CODE_VALUE = 22,
    // A call with this state runs in another context, or was broken off.
    SUPERVISOR_CODE_BUSY = 23,
    // The buffer has no room for everything that may be given.
    SUPERVISOR_CODE_CAPACITY = 24,
    // No step since the start; for the watchdog: since the last answer.
    SUPERVISOR_CODE_NOT_STEPPED = 25,
    // The last step is too long ago: its envelope has expired.
    SUPERVISOR_CODE_EXPIRED = 26,
    // The configuration is not `SUPERVISOR_SEALED_BYTES` long.
    SUPERVISOR_CODE_CONFIG_LENGTH = 32,
    // No sealed configuration, or one of another version.
    SUPERVISOR_CODE_CONFIG_HEADER = 33,
    // The CRC of the configuration does not match.
    SUPERVISOR_CODE_CONFIG_CRC = 34,
    // A word of the configuration is no value of its type.
    SUPERVISOR_CODE_CONFIG_WORD = 35,
    // A configured value is outside its range.
    SUPERVISOR_CODE_CONFIG_RANGE = 36,
    // A relation between configured values does not hold.
    SUPERVISOR_CODE_CONFIG_RELATION = 37,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum SupervisorCode SupervisorCode;
#else
typedef uint32_t SupervisorCode;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

// The actuator channels, in the order of spec §2.
enum SupervisorChannel
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : uint8_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
    // Drive torque.
    SUPERVISOR_CHANNEL_DRIVE_TORQUE = 0,
    // Target speed.
    SUPERVISOR_CHANNEL_TARGET_SPEED = 1,
    // Service brake.
    SUPERVISOR_CHANNEL_SERVICE_BRAKE = 2,
    // Retarder.
    SUPERVISOR_CHANNEL_RETARDER = 3,
    // Gear.
    SUPERVISOR_CHANNEL_GEAR = 4,
    // Electric parking brake.
    SUPERVISOR_CHANNEL_PARKING_BRAKE = 5,
    // Steering.
    SUPERVISOR_CHANNEL_STEERING = 6,
    // Contactors K4 and K1.
    SUPERVISOR_CHANNEL_CONTACTORS = 7,
    // Auxiliaries.
    SUPERVISOR_CHANNEL_AUXILIARIES = 8,
    // Warnings.
    SUPERVISOR_CHANNEL_WARNINGS = 9,
    // Body.
    SUPERVISOR_CHANNEL_BODY = 10,
    // Mode request.
    SUPERVISOR_CHANNEL_MODE = 11,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum SupervisorChannel SupervisorChannel;
#else
typedef uint8_t SupervisorChannel;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

// What happened to a command.
enum SupervisorKind
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : uint8_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
    // Every signal unchanged.
    SUPERVISOR_KIND_PASS = 0,
    // Moved to the nearest safe value.
    SUPERVISOR_KIND_LIMIT = 1,
    // Replaced by the obligation, or by the fallback of a lost command.
    SUPERVISOR_KIND_SUBSTITUTE = 2,
    // Replaced by the channel's neutral value.
    SUPERVISOR_KIND_BLOCK = 3,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum SupervisorKind SupervisorKind;
#else
typedef uint8_t SupervisorKind;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

// Why. The codes are stable; the requirement stands behind each.
enum SupervisorReason
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : uint8_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
    // Inside the envelope.
    SUPERVISOR_REASON_WITHIN = 0,
    // No command in time (E2E-2).
    SUPERVISOR_REASON_COMMAND_LOST = 1,
    // The frame failed its check (rule 5).
    SUPERVISOR_REASON_COMMAND_REJECTED = 2,
    // Safe state (SELF-5).
    SUPERVISOR_REASON_SAFE_STATE = 3,
    // Clock fault in this cycle (SELF-3).
    SUPERVISOR_REASON_CLOCK_FAULT = 4,
    // Somebody else commands an actuator, or one moved by itself (SELF-10).
    SUPERVISOR_REASON_BYPASS = 5,
    // A mitigation level runs (MIT-1 to MIT-5).
    SUPERVISOR_REASON_MITIGATION = 10,
    // Leave runs (SEAT-2, SEAT-3).
    SUPERVISOR_REASON_LEAVE = 11,
    // Speed is lost after an obligation: the bus is held (MIT-7).
    SUPERVISOR_REASON_SPEEDLESS_HOLD = 12,
    // Comfort cap: the road is known to be clear (PHB-1).
    SUPERVISOR_REASON_PHANTOM_BRAKING = 13,
    // Greatest deceleration (PHB-1).
    SUPERVISOR_REASON_BRAKE_CAP = 14,
    // Brake pedal pressed or unknown: no comfort braking (TRQ-3).
    SUPERVISOR_REASON_BRAKE_PEDAL = 15,
    // The driver overrides: no comfort braking (TRQ-4).
    SUPERVISOR_REASON_DRIVER_OVERRIDE = 16,
    // The obligation needs its own mode and priority (spec §2).
    SUPERVISOR_REASON_BRAKE_MODE = 17,
    // Electric limit, unknown, or slip control at work (VLC-2).
    SUPERVISOR_REASON_ELECTRIC_LIMIT = 18,
    // ABS at work (RET-1).
    SUPERVISOR_REASON_ANTI_LOCK = 19,
    // The brakes give less than is obliged: the next stronger means (RSP-1, EPB-1).
    SUPERVISOR_REASON_BRAKE_RESPONSE = 20,
    // More torque than the accelerator allows (TRQ-1).
    SUPERVISOR_REASON_PEDAL_MAP = 30,
    // Accelerator unknown (TRQ-1).
    SUPERVISOR_REASON_ACCELERATOR_UNKNOWN = 31,
    // Both pedals, or the brake pedal is unknown (TRQ-1, TRQ-3).
    SUPERVISOR_REASON_BOTH_PEDALS = 32,
    // The sender's active flag is not set (TRQ-2).
    SUPERVISOR_REASON_NOT_ACTIVE = 33,
    // The mode is not granted by driver evidence (TRQ-2, MODE-1).
    SUPERVISOR_REASON_MODE_NOT_GRANTED = 34,
    // Perception unknown (TRQ-2).
    SUPERVISOR_REASON_PERCEPTION_UNKNOWN = 35,
    // Our own acceleration bound (TRQ-2).
    SUPERVISOR_REASON_ACCELERATION_BOUND = 36,
    // Electric limit of VCU and battery, or unknown (TRQ-5).
    SUPERVISOR_REASON_DRIVE_LIMIT = 37,
    // Rising faster than the gradient (TRQ-5).
    SUPERVISOR_REASON_TORQUE_RAMP = 38,
    // After leave the accelerator has not been seen released (TRQ-5).
    SUPERVISOR_REASON_RELEASE_NEEDED = 39,
    // EPBi torque below the idle torque (TRQ-5).
    SUPERVISOR_REASON_IDLE_TORQUE = 40,
    // A brake demand runs (TRQ-6).
    SUPERVISOR_REASON_BRAKE_DEMAND = 41,
    // The confirmed gear has no drive direction, or differs from the requested one (TRQ-6).
    SUPERVISOR_REASON_GEAR_DIRECTION = 42,
    // Slip control at work or unknown: no rise (RSP-1).
    SUPERVISOR_REASON_SLIP_CONTROL = 43,
    // An obstacle ahead calls for mitigation: no automated torque towards it (TRQ-2).
    SUPERVISOR_REASON_OBSTACLE_AHEAD = 45,
    // The drive gives more than it was told (TRQ-7).
    SUPERVISOR_REASON_EXCESS_TORQUE = 46,
    // The sender belongs to the longitudinal mode that is not configured (VLC-1).
    SUPERVISOR_REASON_NOT_CONFIGURED = 47,
    // Target speed above the limit or above what the mode allows (SPD-1).
    SUPERVISOR_REASON_SPEED_LIMIT = 44,
    // The seat is not confirmed occupied (SEAT-5, SEAT-6, SEAT-8).
    SUPERVISOR_REASON_SEAT_NOT_OCCUPIED = 50,
    // Parked by leave: K1, K4, gear and accelerator are not all confirmed (SEAT-5).
    SUPERVISOR_REASON_PARKED_BY_LEAVE = 51,
    // The parking brake is to be applied (SEAT-4).
    SUPERVISOR_REASON_EPB_APPLY = 52,
    // The driver's own switch says apply (EPB-1).
    SUPERVISOR_REASON_DRIVER_SWITCH = 53,
    // Too fast, or speed unknown, to apply the parking brake (EPB-1).
    SUPERVISOR_REASON_EPB_SPEED = 54,
    // Not at standstill, or speed unknown (GEAR-1, HV-1, AUX-1).
    SUPERVISOR_REASON_NOT_STANDSTILL = 55,
    // The driver's selector does not ask for it, or is unknown (GEAR-1).
    SUPERVISOR_REASON_SELECTOR = 56,
    // Parked by leave: neutral (SEAT-6).
    SUPERVISOR_REASON_NEUTRAL_OBLIGED = 57,
    // High voltage is shut down after leave (SEAT-7).
    SUPERVISOR_REASON_SHUTDOWN = 60,
    // K4 is not confirmed open (SEAT-7, HV-1).
    SUPERVISOR_REASON_K4_NOT_OPEN = 61,
    // Drive or auxiliaries are not confirmed stopped (SEAT-7, HV-1).
    SUPERVISOR_REASON_LOADS_NOT_STOPPED = 62,
    // Closing needs seat, key Off, key Start in that order (SEAT-8).
    SUPERVISOR_REASON_NO_RESTART = 63,
    // K1 is not confirmed closed: K1 closes before K4 (SEAT-8).
    SUPERVISOR_REASON_K1_NOT_CLOSED = 64,
    // A contactor fault is latched: nothing closes (SELF-7).
    SUPERVISOR_REASON_CONTACTOR_FAULT = 65,
    // Automatic steering is not permitted (STR-2).
    SUPERVISOR_REASON_STEERING_REFUSED = 70,
    // The driver has taken over (STR-2).
    SUPERVISOR_REASON_TAKEOVER = 71,
    // The power steering is derated, failed or unknown (STR-2).
    SUPERVISOR_REASON_POWER_STEERING = 72,
    // Outside the speed range, or speed unknown (STR-2).
    SUPERVISOR_REASON_STEERING_SPEED = 73,
    // Angle outside the envelope (STR-1).
    SUPERVISOR_REASON_STEERING_ANGLE = 74,
    // Rate above the bound (STR-1).
    SUPERVISOR_REASON_STEERING_RATE = 75,
    // Overlay torque above the bound (STR-1).
    SUPERVISOR_REASON_STEERING_OVERLAY = 76,
    // Weight above the fade (STR-2) or above 100 %.
    SUPERVISOR_REASON_STEERING_WEIGHT = 77,
    // The bar-torque limit would widen the authority (STR-1).
    SUPERVISOR_REASON_BAR_TORQUE = 78,
    // The steering does not follow (RSP-1).
    SUPERVISOR_REASON_STEERING_RESPONSE = 79,
    // A warning is obliged (FCW-1, PCW-1, SEAT-1, RPT-1).
    SUPERVISOR_REASON_WARNING_OBLIGED = 80,
    // Brake lamps are obliged (BODY-1).
    SUPERVISOR_REASON_BRAKE_LAMPS = 81,
    // Hazard flashers override the indicators (BODY-1).
    SUPERVISOR_REASON_HAZARD_FLASHERS = 82,
    // A percentage above 100 (CMD: fields).
    SUPERVISOR_REASON_FIELD_RANGE = 83,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum SupervisorReason SupervisorReason;
#else
typedef uint8_t SupervisorReason;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

// Who asks for drive torque (S2).
enum SupervisorOrigin
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : uint8_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
    // The driver's pedal.
    SUPERVISOR_ORIGIN_DRIVER = 0,
    // The driver assistance (ADAS-VLC).
    SUPERVISOR_ORIGIN_ADAS = 1,
    // The brake system (EPBi-VLC).
    SUPERVISOR_ORIGIN_EPBI = 2,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum SupervisorOrigin SupervisorOrigin;
#else
typedef uint8_t SupervisorOrigin;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

// Control mode of an external brake request (J1939 SPN 2916).
enum SupervisorBrakeMode
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : uint8_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
    // Request disabled.
    SUPERVISOR_BRAKE_MODE_OFF = 0,
    // Added to the driver's demand.
    SUPERVISOR_BRAKE_MODE_ADDITION = 1,
    // The greater of request and driver's demand: the driver's demand is the floor.
    SUPERVISOR_BRAKE_MODE_MAXIMUM = 2,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum SupervisorBrakeMode SupervisorBrakeMode;
#else
typedef uint8_t SupervisorBrakeMode;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

// Priority of a request (J1939 SPN 2915, 897), 0 is the highest.
enum SupervisorPriority
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : uint8_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
    // Highest: emergency.
    SUPERVISOR_PRIORITY_HIGHEST = 0,
    // High.
    SUPERVISOR_PRIORITY_HIGH = 1,
    // Medium.
    SUPERVISOR_PRIORITY_MEDIUM = 2,
    // Low.
    SUPERVISOR_PRIORITY_LOW = 3,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum SupervisorPriority SupervisorPriority;
#else
typedef uint8_t SupervisorPriority;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

// Mode of a retarder request (J1939 SPN 695).
enum SupervisorRetarderMode
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : uint8_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
    // Request disabled.
    SUPERVISOR_RETARDER_MODE_OFF = 0,
    // Torque control.
    SUPERVISOR_RETARDER_MODE_TORQUE = 2,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum SupervisorRetarderMode SupervisorRetarderMode;
#else
typedef uint8_t SupervisorRetarderMode;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

// A gear request.
enum SupervisorGearRequest
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : uint8_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
    // No request: the gearbox stays where it is.
    SUPERVISOR_GEAR_REQUEST_HOLD = 0,
    // Drive.
    SUPERVISOR_GEAR_REQUEST_DRIVE = 1,
    // Reverse.
    SUPERVISOR_GEAR_REQUEST_REVERSE = 2,
    // Neutral.
    SUPERVISOR_GEAR_REQUEST_NEUTRAL = 3,
    // Park.
    SUPERVISOR_GEAR_REQUEST_PARK = 4,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum SupervisorGearRequest SupervisorGearRequest;
#else
typedef uint8_t SupervisorGearRequest;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

// A parking-brake request.
enum SupervisorEpbRequest
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : uint8_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
    // No request: the brake stays as it is.
    SUPERVISOR_EPB_REQUEST_NONE = 0,
    // Apply.
    SUPERVISOR_EPB_REQUEST_APPLY = 1,
    // Release.
    SUPERVISOR_EPB_REQUEST_RELEASE = 2,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum SupervisorEpbRequest SupervisorEpbRequest;
#else
typedef uint8_t SupervisorEpbRequest;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

// Who may operate the EPB (S4 BKR 19).
enum SupervisorEpbMode
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : uint8_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
    // Only the driver's switch.
    SUPERVISOR_EPB_MODE_MANUAL = 0,
    // External requests too.
    SUPERVISOR_EPB_MODE_AUTOMATIC = 1,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum SupervisorEpbMode SupervisorEpbMode;
#else
typedef uint8_t SupervisorEpbMode;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

// A contactor request.
enum SupervisorContactorRequest
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : uint8_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
    // No request: the contactor stays as it is.
    SUPERVISOR_CONTACTOR_REQUEST_HOLD = 0,
    // Open.
    SUPERVISOR_CONTACTOR_REQUEST_OPEN = 1,
    // Close.
    SUPERVISOR_CONTACTOR_REQUEST_CLOSE = 2,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum SupervisorContactorRequest SupervisorContactorRequest;
#else
typedef uint8_t SupervisorContactorRequest;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

// Wipers.
enum SupervisorWiper
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : uint8_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
    // Off.
    SUPERVISOR_WIPER_OFF = 0,
    // Interval.
    SUPERVISOR_WIPER_INTERVAL = 1,
    // Slow.
    SUPERVISOR_WIPER_SLOW = 2,
    // Fast.
    SUPERVISOR_WIPER_FAST = 3,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum SupervisorWiper SupervisorWiper;
#else
typedef uint8_t SupervisorWiper;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

// Requested driving mode.
enum SupervisorDrivingMode
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : uint8_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
    // The driver drives.
    SUPERVISOR_DRIVING_MODE_MANUAL = 0,
    // Automated longitudinal control.
    SUPERVISOR_DRIVING_MODE_AUTOMATED = 1,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum SupervisorDrivingMode SupervisorDrivingMode;
#else
typedef uint8_t SupervisorDrivingMode;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

// Why the supervisor starts.
enum SupervisorResetCause
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : uint8_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
    // Power was switched on (key-on).
    SUPERVISOR_RESET_CAUSE_POWER_ON = 0,
    // The watchdog.
    SUPERVISOR_RESET_CAUSE_WATCHDOG = 1,
    // Anything else: brown-out, software, unknown.
    SUPERVISOR_RESET_CAUSE_OTHER = 2,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum SupervisorResetCause SupervisorResetCause;
#else
typedef uint8_t SupervisorResetCause;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

// What was persisted, protected by the integrator's CRC.
enum SupervisorRecord
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : uint8_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
    // Nothing.
    SUPERVISOR_RECORD_NONE = 0,
    // In leave, or parked by leave.
    SUPERVISOR_RECORD_LEAVE = 1,
    // High voltage is being, or was, shut down after leave.
    SUPERVISOR_RECORD_HIGH_VOLTAGE_DOWN = 2,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum SupervisorRecord SupervisorRecord;
#else
typedef uint8_t SupervisorRecord;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

// The longitudinal mode as granted.
enum SupervisorMode
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : uint8_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
    // The driver drives.
    SUPERVISOR_MODE_MANUAL = 0,
    // Automated.
    SUPERVISOR_MODE_AUTOMATED = 1,
    // Automated, but the driver's accelerator governs for now (TRQ-4).
    SUPERVISOR_MODE_SUSPENDED = 2,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum SupervisorMode SupervisorMode;
#else
typedef uint8_t SupervisorMode;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

// How far the shutdown after leave has gone.
enum SupervisorStage
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : uint8_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
    // Not begun.
    SUPERVISOR_STAGE_UP = 0,
    // Committed: K4 opens.
    SUPERVISOR_STAGE_OPENING_K4 = 1,
    // K4 was confirmed open: loads stop, then K1 opens.
    SUPERVISOR_STAGE_OPENING_K1 = 2,
    // Both were confirmed open.
    SUPERVISOR_STAGE_DOWN = 3,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum SupervisorStage SupervisorStage;
#else
typedef uint8_t SupervisorStage;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

// What the supervisor says of the seat.
enum SupervisorOccupancy
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : uint8_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
    // Confirmed occupied.
    SUPERVISOR_OCCUPANCY_CONFIRMED = 0,
    // Not confirmed; no leave runs.
    SUPERVISOR_OCCUPANCY_NOT_CONFIRMED = 1,
    // Leave runs.
    SUPERVISOR_OCCUPANCY_LEAVE = 2,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum SupervisorOccupancy SupervisorOccupancy;
#else
typedef uint8_t SupervisorOccupancy;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

// Why the automated mode ended (S4 ACR 8, MODE-1).
enum SupervisorExitReason
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : uint8_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
    // It has not ended.
    SUPERVISOR_EXIT_REASON_NONE = 0,
    // Asked for by the main controller.
    SUPERVISOR_EXIT_REASON_REQUESTED = 1,
    // Brake pedal pressed or unknown.
    SUPERVISOR_EXIT_REASON_BRAKE_PEDAL = 2,
    // The driver took over the steering.
    SUPERVISOR_EXIT_REASON_TAKEOVER = 3,
    // The cruise switch is off or unknown.
    SUPERVISOR_EXIT_REASON_SWITCH = 4,
    // The automated driving system is not valid.
    SUPERVISOR_EXIT_REASON_ADS_STATE = 5,
    // The brake request was lost.
    SUPERVISOR_EXIT_REASON_COMMAND_LOST = 6,
    // An input group that the mode needs is unknown.
    SUPERVISOR_EXIT_REASON_INPUT_LOST = 7,
    // The driver left the seat.
    SUPERVISOR_EXIT_REASON_LEAVE = 8,
    // Clock fault or safe state.
    SUPERVISOR_EXIT_REASON_FAULT = 9,
    // A mitigation level has begun: it needs new driver evidence afterwards.
    SUPERVISOR_EXIT_REASON_MITIGATION = 10,
    // Somebody else commands an actuator, or the drive does not obey (SELF-10, TRQ-7).
    SUPERVISOR_EXIT_REASON_BYPASS = 11,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum SupervisorExitReason SupervisorExitReason;
#else
typedef uint8_t SupervisorExitReason;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

// Level of collision mitigation that the time to collision calls for (S1 §3.1.2).
enum SupervisorLevel
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : uint8_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
    // None.
    SUPERVISOR_LEVEL_NONE = 0,
    // Level 1: 1.0 m/s².
    SUPERVISOR_LEVEL_ONE = 1,
    // Level 2: 2.5 m/s².
    SUPERVISOR_LEVEL_TWO = 2,
    // Level 3: 5.0 m/s².
    SUPERVISOR_LEVEL_THREE = 3,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum SupervisorLevel SupervisorLevel;
#else
typedef uint8_t SupervisorLevel;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

// Faults and hints: the bits of `faults` in the status.
enum SupervisorFault
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : uint32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
    // dt outside its range in this cycle (SELF-3).
    SUPERVISOR_FAULT_CLOCK = 1,
    // Retained state did not decode (SELF-5); latched.
    SUPERVISOR_FAULT_STATE = 2,
    // Three clock faults in a row (SELF-3); latched.
    SUPERVISOR_FAULT_CLOCK_LATCHED = 4,
    // The configuration changed at run time (SELF-4); latched.
    SUPERVISOR_FAULT_CONFIGURATION = 8,
    // The seat sensors disagree (SEAT-10).
    SUPERVISOR_FAULT_SEAT_DISAGREE = 16,
    // A seat sensor is unknown (SEAT-10).
    SUPERVISOR_FAULT_SEAT_UNKNOWN = 32,
    // The speeds disagree or one is unknown (rule 6).
    SUPERVISOR_FAULT_SPEED_UNKNOWN = 64,
    // The parking brake did not confirm in time (SEAT-4).
    SUPERVISOR_FAULT_EPB_UNCONFIRMED = 128,
    // K4 did not confirm in time (SEAT-7).
    SUPERVISOR_FAULT_K4_OVERDUE = 256,
    // The loads did not stop or K1 did not confirm in time (SEAT-7).
    SUPERVISOR_FAULT_K1_OVERDUE = 512,
    // Perception is unknown (MIT-7).
    SUPERVISOR_FAULT_PERCEPTION_UNKNOWN = 1024,
    // Time to collision and the second opinion disagree (MIT-8).
    SUPERVISOR_FAULT_TTC_DISAGREEMENT = 2048,
    // The drive command is lost (E2E-2).
    SUPERVISOR_FAULT_DRIVE_COMMAND_LOST = 4096,
    // The brake command is lost (E2E-2).
    SUPERVISOR_FAULT_BRAKE_COMMAND_LOST = 8192,
    // The steering command is lost (E2E-2).
    SUPERVISOR_FAULT_STEERING_COMMAND_LOST = 16384,
    // The accelerator tracks disagree or one is unknown (TRQ-1).
    SUPERVISOR_FAULT_ACCELERATOR_UNKNOWN = 32768,
    // The brake pedal is unknown (TRQ-3).
    SUPERVISOR_FAULT_BRAKE_PEDAL_UNKNOWN = 65536,
    // EBS red warning.
    SUPERVISOR_FAULT_EBS_RED = 131072,
    // The driver has taken over (STR-2).
    SUPERVISOR_FAULT_TAKEOVER = 262144,
    // The drive does not reach its torque in time, or stays beyond 15 % below it (RSP-1).
    SUPERVISOR_FAULT_DRIVE_RESPONSE = 524288,
    // The brakes do not reach their deceleration in time, stay beyond 15 % below it, or can not give it (RSP-1).
    SUPERVISOR_FAULT_BRAKE_RESPONSE = 1048576,
    // The gearbox does not follow in time (RSP-1).
    SUPERVISOR_FAULT_GEAR_RESPONSE = 2097152,
    // The steering does not follow in time (RSP-1).
    SUPERVISOR_FAULT_STEERING_RESPONSE = 4194304,
    // The drive gives more torque than it was told (TRQ-7).
    SUPERVISOR_FAULT_EXCESS_TORQUE = 8388608,
    // An actuator was commanded or moved past us (SELF-10).
    SUPERVISOR_FAULT_BYPASS = 16777216,
    // Somebody sends under our address (SELF-10).
    SUPERVISOR_FAULT_SECOND_SENDER = 33554432,
    // A contactor moved by itself or did not follow (SELF-7); latched.
    SUPERVISOR_FAULT_CONTACTOR = 67108864,
    // A stage of the cycle was skipped, repeated or out of order (SELF-6); latched.
    SUPERVISOR_FAULT_FLOW = 134217728,
    // A value by which the brake system splits is not plausible (VLC-3).
    SUPERVISOR_FAULT_SPLIT_IMPLAUSIBLE = 268435456,
    // The brakes give beyond 15 % more than they were told (RSP-1).
    SUPERVISOR_FAULT_BRAKE_OVERSHOOT = 536870912,
    // The steering goes beyond 15 % over its target (RSP-1).
    SUPERVISOR_FAULT_STEERING_OVERSHOOT = 1073741824,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum SupervisorFault SupervisorFault;
#else
typedef uint32_t SupervisorFault;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

// Failure mode identifier of J1939-73: in which way. Only those that our table speaks of, or soon will.
enum SupervisorFmi
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : uint8_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
    // Data valid but above the normal range, most severe.
    SUPERVISOR_FMI_ABOVE_NORMAL = 0,
    // Data erratic, intermittent or incorrect.
    SUPERVISOR_FMI_ERRATIC = 2,
    // Mechanical system not responding, or out of adjustment.
    SUPERVISOR_FMI_NOT_RESPONDING = 7,
    // Abnormal update rate.
    SUPERVISOR_FMI_UPDATE_RATE = 9,
    // Bad intelligent device or component.
    SUPERVISOR_FMI_BAD_DEVICE = 12,
    // Out of calibration.
    SUPERVISOR_FMI_CALIBRATION = 13,
    // Data valid but above the normal range, moderately severe.
    SUPERVISOR_FMI_ABOVE_NORMAL_MODERATE = 16,
    // Received network data in error.
    SUPERVISOR_FMI_NETWORK_DATA = 19,
    // Condition exists.
    SUPERVISOR_FMI_CONDITION_EXISTS = 31,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum SupervisorFmi SupervisorFmi;
#else
typedef uint8_t SupervisorFmi;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

// The lamp that a code lights (J1939-73). Ours are never emission-related: the MIL stays off.
enum SupervisorLamp
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : uint8_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
    // None: a hint, no fault (`Faults::HINTS`).
    SUPERVISOR_LAMP_NONE = 0,
    // Amber warning lamp: drive on with what still works.
    SUPERVISOR_LAMP_AMBER_WARNING = 1,
    // Red stop lamp: stop the bus safely.
    SUPERVISOR_LAMP_RED_STOP = 2,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum SupervisorLamp SupervisorLamp;
#else
typedef uint8_t SupervisorLamp;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

// What does not work, as the ADS is told. The codes are stable.
enum SupervisorSystem
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : uint8_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
    // The supervisor itself.
    SUPERVISOR_SYSTEM_SUPERVISOR = 0,
    // Drive.
    SUPERVISOR_SYSTEM_DRIVE = 1,
    // Service brake.
    SUPERVISOR_SYSTEM_BRAKE = 2,
    // Steering.
    SUPERVISOR_SYSTEM_STEERING = 3,
    // Gearbox.
    SUPERVISOR_SYSTEM_GEAR = 4,
    // Parking brake.
    SUPERVISOR_SYSTEM_PARKING_BRAKE = 5,
    // High voltage.
    SUPERVISOR_SYSTEM_HIGH_VOLTAGE = 6,
    // Seat sensors.
    SUPERVISOR_SYSTEM_SEAT = 7,
    // Radar and camera.
    SUPERVISOR_SYSTEM_PERCEPTION = 8,
    // Lamps and wipers.
    SUPERVISOR_SYSTEM_BODY = 9,
    // Speed.
    SUPERVISOR_SYSTEM_SPEED = 10,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum SupervisorSystem SupervisorSystem;
#else
typedef uint8_t SupervisorSystem;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

// What is wrong with a frame: `fault` of the receipt.
enum SupervisorFrameFault
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : uint8_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
    // Nothing: it was accepted.
    SUPERVISOR_FRAME_FAULT_NONE = 0,
    // No message has this identifier.
    SUPERVISOR_FRAME_FAULT_IDENTIFIER = 1,
    // A command from a source that is not listened to; with the supervisor's own address, a second sender of it.
    SUPERVISOR_FRAME_FAULT_SOURCE = 2,
    // Not 8 bytes.
    SUPERVISOR_FRAME_FAULT_LENGTH = 3,
    // CRC or checksum wrong.
    SUPERVISOR_FRAME_FAULT_CHECKSUM = 4,
    // The counter is reserved or "not available".
    SUPERVISOR_FRAME_FAULT_NO_COUNTER = 5,
    // A reserved bit is wrong.
    SUPERVISOR_FRAME_FAULT_RESERVED = 6,
    // A signal has a value that is not in its table.
    SUPERVISOR_FRAME_FAULT_SIGNAL = 7,
    // The counter has not moved: a repeated or frozen frame.
    SUPERVISOR_FRAME_FAULT_REPEATED = 8,
    // The counter went back, or on by more than is tolerated.
    SUPERVISOR_FRAME_FAULT_SEQUENCE = 9,
    // The first frame after a gap: nothing yet shows that its counter runs.
    SUPERVISOR_FRAME_FAULT_NO_PREDECESSOR = 10,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum SupervisorFrameFault SupervisorFrameFault;
#else
typedef uint8_t SupervisorFrameFault;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

// What an event tells: `what` of the event.
enum SupervisorEventKind
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : uint8_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
    // The verdict of a channel: its kind or its reason changed.
    SUPERVISOR_EVENT_KIND_VERDICT = 0,
    // The seat; `code` is a `SupervisorOccupancy`.
    SUPERVISOR_EVENT_KIND_OCCUPANCY = 1,
    // Parked by leave began (1) or ended (0).
    SUPERVISOR_EVENT_KIND_PARKED_BY_LEAVE = 2,
    // Stage of the shutdown of high voltage; `code` is a `SupervisorStage`.
    SUPERVISOR_EVENT_KIND_STAGE = 3,
    // Mitigation level; `code` is a `SupervisorLevel`.
    SUPERVISOR_EVENT_KIND_LEVEL = 4,
    // Longitudinal mode; `code` is a `SupervisorMode`.
    SUPERVISOR_EVENT_KIND_MODE = 5,
    // The safe state began (1) or ended (0).
    SUPERVISOR_EVENT_KIND_SAFE_STATE = 6,
    // The set of faults; `code` has a bit for each, see `SupervisorFault`.
    SUPERVISOR_EVENT_KIND_FAULTS = 7,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum SupervisorEventKind SupervisorEventKind;
#else
typedef uint8_t SupervisorEventKind;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

// Event record and trouble codes. It only reads what was decided: it may stand in a partition of less trust.
typedef struct SupervisorDiagnosis {
    uint64_t words[SUPERVISOR_DIAGNOSIS_WORDS];
} SupervisorDiagnosis;

// The state of a supervisor. Allocate it statically, where only the supervisor's partition can write (AOU-04), and
// initialise it with `supervisor_init`; what is in it is nobody else's concern. It may not be copied: two copies would
// send the same counters.
typedef struct SupervisorState {
    uint64_t words[SUPERVISOR_STATE_WORDS];
} SupervisorState;

// What lamps and wipers say of themselves: 1 on, 0 off, a `SupervisorWiper` for the wipers; every other number is
// unknown. What has never been known is not watched.
typedef struct SupervisorBodyFeedback {
    // Wipers.
    uint8_t wipers;
    // Brake lamps.
    uint8_t brake_lamps;
    // Left indicator: switched on, or the phase of its flashing.
    uint8_t indicator_left;
    // Right indicator, the same.
    uint8_t indicator_right;
    // Low beam.
    uint8_t low_beam;
    // High beam.
    uint8_t high_beam;
} SupervisorBodyFeedback;

// One change, with its time.
typedef struct SupervisorEvent {
    // Time of the step, in ms.
    uint32_t time_ms;
    // Of a verdict: the value.
    int32_t value;
    // Of a verdict: the limit.
    int32_t limit;
    // Of a verdict: the margin.
    int32_t margin;
    // Of everything else: what it is now.
    uint32_t code;
    // What changed, a `SupervisorEventKind`.
    uint8_t what;
    // Of a verdict: the channel, a `SupervisorChannel`.
    uint8_t channel;
    // Of a verdict: a `SupervisorKind`.
    uint8_t kind;
    // Of a verdict: a `SupervisorReason`.
    uint8_t reason;
} SupervisorEvent;

// A trouble code that is active.
typedef struct SupervisorTrouble {
    // Suspect parameter number of J1939, 19 bits.
    uint32_t spn;
    // Failure mode identifier, a `SupervisorFmi`.
    uint8_t fmi;
    // The lamp that it lights, a `SupervisorLamp`.
    uint8_t lamp;
    // What does not work, a `SupervisorSystem`.
    uint8_t system;
    // Why, as one number: 1 + bit of the fault, or 64 + part of the body.
    uint8_t ads_code;
    // How often it has become active, 1 to 126.
    uint8_t occurrences;
    // The fault is there in this cycle: 1, or 0 while the code waits to heal.
    uint8_t present;
    // Given as 0.
    uint8_t reserved[2];
} SupervisorTrouble;

// A CAN frame with a 29-bit identifier. The messages stand in `supervisor/wire/ebus.dbc`.
typedef struct SupervisorFrame {
    // Identifier, 29 bits, without any flag.
    uint32_t id;
    // Data; bytes beyond `length` have no meaning.
    uint8_t data[8];
    // Number of data bytes, 0 to 8.
    uint8_t length;
    // Given as 0, not looked at.
    uint8_t reserved[3];
} SupervisorFrame;

// What came of a frame.
typedef struct SupervisorReceipt {
    // The number of its message in the table of `supervisor/wire`; 255 if no message has its identifier.
    uint8_t message;
    // 0, or a `SupervisorFrameFault`.
    uint8_t fault;
    // How many frames before it are missing by the counter; tolerated, to be reported.
    uint8_t lost;
    // Given as 0.
    uint8_t reserved;
} SupervisorReceipt;

// The verdict of one channel.
//
// `value` and `limit` are in the unit of the field that `reason` speaks of; for yes/no fields 0 and 1, for codes the
// code. `margin` is how far inside (positive) or outside (negative) the value was.
typedef struct SupervisorVerdict {
    // The offending (or the tightest) value.
    int32_t value;
    // Its limit.
    int32_t limit;
    // How far inside or outside.
    int32_t margin;
    // A `SupervisorKind`.
    uint8_t kind;
    // A `SupervisorReason`.
    uint8_t reason;
    // Given as 0.
    uint8_t reserved[2];
} SupervisorVerdict;

// Where the supervisor stands.
typedef struct SupervisorStatus {
    // Time parked by leave towards the shutdown of high voltage, in ms.
    uint32_t parked_for_ms;
    // Faults and hints of this cycle, see `SupervisorFault`.
    uint32_t faults;
    // A `SupervisorOccupancy`.
    uint8_t occupancy;
    // Parked by leave, 0 or 1.
    uint8_t parked_by_leave;
    // A `SupervisorStage`.
    uint8_t stage;
    // A `SupervisorLevel`.
    uint8_t level;
    // A `SupervisorMode`.
    uint8_t mode;
    // Why the automated mode last ended, a `SupervisorExitReason`.
    uint8_t exit;
    // Safe state, 0 or 1.
    uint8_t safe_state;
    // A `SupervisorRecord`: what to persist now, under a CRC of your own (AOU-10).
    uint8_t record;
} SupervisorStatus;

// One value for every field of every channel. What is on or off is 1 or 0; what has codes says of which table.
typedef struct SupervisorOutputs {
    // Target speed, 1/256 km/h.
    uint16_t target_speed;
    // Service brake: total deceleration, 1/2048 m/s².
    uint16_t brake_total;
    // Service brake: the electric part of it, 1/2048 m/s².
    uint16_t brake_electric;
    // Steering: target angle, 0.1°, left positive.
    int16_t steering_angle;
    // Steering: greatest rate, 0.1°/s.
    uint16_t steering_rate;
    // Steering: overlay torque, 1/1024 Nm.
    int16_t steering_overlay;
    // Drive torque in the direction of the gear, %.
    uint8_t drive_torque;
    // Drive torque: the sender's active flag.
    uint8_t drive_active;
    // Drive torque: a `SupervisorOrigin`.
    uint8_t drive_origin;
    // Service brake: a `SupervisorBrakeMode`.
    uint8_t brake_mode;
    // Service brake: a `SupervisorPriority`.
    uint8_t brake_priority;
    // Retarder: braking torque, %.
    uint8_t retarder_torque;
    // Retarder: a `SupervisorRetarderMode`.
    uint8_t retarder_mode;
    // Retarder: a `SupervisorPriority`.
    uint8_t retarder_priority;
    // A `SupervisorGearRequest`.
    uint8_t gear;
    // Parking brake: a `SupervisorEpbRequest`.
    uint8_t epb_request;
    // Parking brake: a `SupervisorEpbMode`.
    uint8_t epb_mode;
    // Steering: automatic steering enabled.
    uint8_t steering_enable;
    // Steering: weight of the angle controller's torque, %.
    uint8_t steering_weight;
    // Steering: limit of the overlaid bar torque, 0.05 Nm.
    uint8_t steering_bar_limit;
    // Contactor K4 (drive and auxiliary front end): a `SupervisorContactorRequest`.
    uint8_t k4;
    // Contactor K1 (battery main circuit): a `SupervisorContactorRequest`.
    uint8_t k1;
    // Air pump.
    uint8_t air_pump;
    // Power steering.
    uint8_t power_steering;
    // DC/DC converter.
    uint8_t dc_dc;
    // Forward-collision warning.
    uint8_t forward_collision;
    // Pedestrian-collision warning.
    uint8_t pedestrian;
    // Seat-leave warning.
    uint8_t seat_leave;
    // Hazard flashers.
    uint8_t hazard_flashers;
    // Fault lamp.
    uint8_t fault_lamp;
    // Notice lamp.
    uint8_t notice_lamp;
    // Lane-departure warning.
    uint8_t lane_departure;
    // Speed-limit warning.
    uint8_t speed_limit;
    // Headway warning.
    uint8_t headway;
    // A `SupervisorWiper`.
    uint8_t wipers;
    // Brake lamps.
    uint8_t brake_lamps;
    // Left indicator.
    uint8_t indicator_left;
    // Right indicator.
    uint8_t indicator_right;
    // Low beam.
    uint8_t low_beam;
    // High beam.
    uint8_t high_beam;
    // Horn.
    uint8_t horn;
    // A `SupervisorDrivingMode`.
    uint8_t mode;
} SupervisorOutputs;

// Everything that a step decided.
typedef struct SupervisorDecision {
    // One for each channel, in the order of `SupervisorChannel`.
    struct SupervisorVerdict verdicts[SUPERVISOR_CHANNELS];
    // Where the supervisor stands.
    struct SupervisorStatus status;
    // What goes to the actuators; the frames say the same.
    struct SupervisorOutputs outputs;
} SupervisorDecision;

#ifdef __cplusplus
extern "C" {
#endif // __cplusplus

// Takes over what the last step decided; once after every step. The state is only read.
//
// `feedback` is what lamps and wipers say of themselves, or null.
//
// # Safety
// Each pointer leads to one value of its type; nothing else touches them during the call.
SUPERVISOR_MUST_USE
SupervisorCode supervisor_diagnosis_observe(struct SupervisorDiagnosis *diagnosis,
                                            struct SupervisorState *state,
                                            const struct SupervisorBodyFeedback *feedback);

// The last changes of verdicts and status, from the oldest to the newest; of a longer record the newest `capacity`.
// `count` says how many were written, `dropped` (or null) how many the record had no room for.
//
// # Safety
// `events` leads to room for `capacity` events, each other pointer to one value of its type; nothing else touches them
// during the call.
SUPERVISOR_MUST_USE
SupervisorCode supervisor_diagnosis_events(struct SupervisorDiagnosis *diagnosis,
                                           struct SupervisorEvent *events,
                                           size_t capacity,
                                           size_t *count,
                                           uint32_t *dropped);

// The trouble codes that are active, debounced, in the order of the table; `SUPERVISOR_TROUBLES` at most. `count` says
// how many were written.
//
// # Safety
// `troubles` leads to room for `capacity` codes, each other pointer to one value of its type; nothing else touches
// them during the call.
SUPERVISOR_MUST_USE
SupervisorCode supervisor_diagnosis_troubles(struct SupervisorDiagnosis *diagnosis,
                                             struct SupervisorTrouble *troubles,
                                             size_t capacity,
                                             size_t *count);

// The frame of J1939 DM1 to send now; `SUPERVISOR_CODE_NOTHING` if none is due. Once in every cycle.
//
// # Safety
// Each pointer leads to one value of its type; nothing else touches them during the call.
SUPERVISOR_MUST_USE
SupervisorCode supervisor_diagnosis_dm1(struct SupervisorDiagnosis *diagnosis,
                                        uint32_t now_ms,
                                        struct SupervisorFrame *frame);

// The version of the library's interface; that of the header is `SUPERVISOR_ABI_VERSION`.
SUPERVISOR_MUST_USE uint32_t supervisor_abi_version(void);

// Bytes of a `SupervisorState`.
SUPERVISOR_MUST_USE size_t supervisor_state_bytes(void);

// Alignment of a `SupervisorState`.
SUPERVISOR_MUST_USE size_t supervisor_state_alignment(void);

// Bytes of a `SupervisorDiagnosis`.
SUPERVISOR_MUST_USE size_t supervisor_diagnosis_bytes(void);

// Alignment of a `SupervisorDiagnosis`.
SUPERVISOR_MUST_USE size_t supervisor_diagnosis_alignment(void);

// Bytes of a sealed configuration.
SUPERVISOR_MUST_USE size_t supervisor_sealed_bytes(void);

// How many frames a step gives at most.
SUPERVISOR_MUST_USE size_t supervisor_output_frames(void);

// Takes in a frame of the sensors or of the main controller, as it was read from the bus, of whatever identifier.
//
// `now_ms` is the time at which it was read. `receipt` may be null. `SUPERVISOR_CODE_FRAME_REFUSED` is nothing to
// react to: the vetting knows that the frame failed.
//
// # Safety
// Each pointer leads to one value of its type; nothing else touches them during the call.
SUPERVISOR_MUST_USE
SupervisorCode supervisor_receive(struct SupervisorState *state,
                                  uint32_t now_ms,
                                  const struct SupervisorFrame *frame,
                                  struct SupervisorReceipt *receipt);

// Takes in a frame that the supervisor's node reads from the bus of the actuators, its own echoes among them
// (SELF-10): a command that is not ours is found, reported, and answered by the next step.
//
// Feedback that comes by this bus goes to `supervisor_receive`, too. `receipt` may be null.
//
// # Safety
// As for `supervisor_receive`.
SUPERVISOR_MUST_USE
SupervisorCode supervisor_receive_actuator(struct SupervisorState *state,
                                           uint32_t now_ms,
                                           const struct SupervisorFrame *frame,
                                           struct SupervisorReceipt *receipt);

// One cycle, every 10 ms: reads what came, decides, vets every channel, and gives the frames to send, in order.
//
// `now_ms` is the time of the cycle; it may wrap. `frames` has room for `capacity` frames, at least
// `SUPERVISOR_OUTPUT_FRAMES`, or nothing is done; `count` says how many were written. Send them as they are.
// Whatever came in or did not come, the step gives its frames; a step that is refused gives none.
//
// # Safety
// `frames` leads to room for `capacity` frames, each other pointer to one value of its type; nothing else touches
// them during the call.
SUPERVISOR_MUST_USE
SupervisorCode supervisor_step(struct SupervisorState *state,
                               uint32_t now_ms,
                               struct SupervisorDecision *decision,
                               struct SupervisorFrame *frames,
                               size_t capacity,
                               size_t *count);

// The four bytes for the watchdog's question (its low four bits), in the order in which they are sent (SELF-6).
//
// Right only after a step that ran whole and in order, and once for each step: the second answer, and the one before
// the first step, are wrong, and the code says so. If the call is refused for another reason, the answer is four
// zeros, which is wrong for every question.
//
// # Safety
// `answer` leads to room for `SUPERVISOR_ANSWER_BYTES` bytes, `state` to a state; nothing else touches them during the
// call.
SUPERVISOR_MUST_USE
SupervisorCode supervisor_watchdog(struct SupervisorState *state,
                                   uint8_t question,
                                   uint8_t *answer);

// Starts a supervisor in the caller's memory (SELF-9). Once after every reset; whatever the memory held is given up.
//
// `bytes` is `sizeof` the state, `abi_version` is `SUPERVISOR_ABI_VERSION`, `reset_cause` a `SupervisorResetCause`,
// `record` the `SupervisorRecord` that was persisted, or `SUPERVISOR_RECORD_BROKEN` if it fails its CRC. The
// configuration is copied: `supervise config seal` makes the bytes. If it is refused there is no supervisor: every
// later call with this state is refused, too.
//
// # Safety
// `state` leads to writable memory of `bytes` bytes that was written at least once (zeros will do), `sealed` to
// `sealed_bytes` readable ones.
SUPERVISOR_MUST_USE
SupervisorCode supervisor_init(struct SupervisorState *state,
                               size_t bytes,
                               uint32_t abi_version,
                               const uint8_t *sealed,
                               size_t sealed_bytes,
                               uint8_t reset_cause,
                               uint8_t record);

// Starts a diagnosis in the caller's memory: nothing has happened yet.
//
// # Safety
// `diagnosis` leads to writable memory of `bytes` bytes that was written at least once (zeros will do).
SUPERVISOR_MUST_USE
SupervisorCode supervisor_diagnosis_init(struct SupervisorDiagnosis *diagnosis,
                                         size_t bytes,
                                         uint32_t abi_version);

// Vets one command of one channel against the envelope of the last step, and changes nothing: for a gateway that
// forwards frames between two steps.
//
// `channel` is a `SupervisorChannel`; of `asked` only its fields count. `outputs` becomes the outputs of the last step
// with this channel replaced by what may go out; `verdict` says why. A code that is not in its table is a command that
// was rejected. Channels that are coupled (mode and gear to torque; brake to retarder, torque and brake lamps; torque
// to K4) are judged beside the outputs of the last step; what a new brake demand means for the others follows in the
// next step. The envelope expires with the cycle: after the configured longest cycle it is refused.
//
// # Safety
// Each pointer leads to one value of its type; nothing else touches them during the call.
SUPERVISOR_MUST_USE
SupervisorCode supervisor_vet(struct SupervisorState *state,
                              uint32_t now_ms,
                              uint8_t channel,
                              const struct SupervisorOutputs *asked,
                              struct SupervisorOutputs *outputs,
                              struct SupervisorVerdict *verdict);

#ifdef __cplusplus
}  // extern "C"
#endif  // __cplusplus

#endif  /* SUPERVISOR_H */
